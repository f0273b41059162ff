// Seeds that are text: configurations, cameras, poses, names of data sets.
#include "io/views/camera_file.h"
#include "seeds.h"
#include "train/config/config_file.h"

namespace svnet::fuzz {
namespace {

void add_configurations(const Seeds& seeds) {
  seeds.add("config", "defaults", train::to_yaml(train::Config()));
  seeds.add("config", "documented", train::documented_yaml(train::Config(), "/nowhere"));
  seeds.add("config", "short",
            "preset: paper\nseed: 3\ndataset:\n  root: data\n  held_out: [ring, 'a b']\nscores:\n  problems: 4e3\n");
  seeds.add("config", "flow", "{seed: 1, dataset: {root: \"x\\ty\", held_out: []}, training: {epochs: ~}}\n");
  seeds.add("override", "some", "seed=4\ndataset.held_out=[a, b]\nscores.problems=4e7\ndataset.root=");
  for (const train::ConfigKey& key : train::config_keys())
    for (const char* target : {"config", "override"}) {
      seeds.add_word(target, key.name.substr(key.name.rfind('.') + 1));
      seeds.add_word(target, key.name);
      if (key.default_value.size() < 40 && !key.default_value.empty()) seeds.add_word(target, key.default_value);
    }
  for (const char* word : {"---\n", "...", "&a", "*a", "!!str", "<<: ", "? ", "- ", ": ", "|\n", ">-\n", "%YAML 1.2\n",
                           ".inf", ".nan", "0x10", "1e400", "\xef\xbb\xbf", "\xe2\x80\xa8"})
    seeds.add_word("config", word);
}

void add_cameras(const Seeds& seeds) {
  const view::Intrinsics k{640, 480, 600, 601, 319.5, 239.5};
  seeds.add("camera", "plain", io::camera_json({k, {}}));
  seeds.add("camera", "posed", io::camera_json({k, Eigen::Isometry3d::Identity()}));
  seeds.add("camera", "realsense",
            R"({"width":640,"height":480,"ppx":320.5,"ppy":240,"fx":600,"fy":600,"model":"distortion.brown_conrady",)"
            R"("coeffs":[0,0,0,0,0]})");
  seeds.add("camera", "ros_message",
            "header:\n  frame_id: cam\nheight: 480\nwidth: 640\ndistortion_model: plumb_bob\nd: [0, 0, 0, 0, 0]\n"
            "k: [600, 0, 320, 0, 600, 240, 0, 0, 1]\nr: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n"
            "p: [600, 0, 320, 0, 0, 600, 240, 0, 0, 0, 1, 0]\nbinning_x: 0\nbinning_y: 0\nroi:\n  x_offset: 0\n---\n");
  seeds.add("camera", "ros_file",
            "image_width: 640\nimage_height: 480\ncamera_name: c\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
            "  data: [600, 0, 320, 0, 600, 240, 0, 0, 1]\ndistortion_model: plumb_bob\ndistortion_coefficients:\n"
            "  rows: 1\n  cols: 5\n  data: [0, 0, 0, 0, 0]\nrectification_matrix:\n  rows: 3\n  cols: 3\n"
            "  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]\nprojection_matrix:\n  rows: 3\n  cols: 4\n"
            "  data: [600, 0, 320, 0, 0, 600, 240, 0, 0, 0, 1, 0]\n");
  for (const char* word : {"width",  "height",      "fx",
                           "fy",     "cx",          "cy",
                           "ppx",    "ppy",         "model",
                           "coeffs", "pose",        "x_m",
                           "qx",     "qw",          "distortion_model",
                           "D",      "K",           "R",
                           "P",      "image_width", "camera_matrix",
                           "data",   "rows",        "cols",
                           "&a ",    "*a",          "[",
                           "{",      "\"",          "1e300",
                           "-0",     "null"})
    seeds.add_word("camera", word);
}

void add_poses(const Seeds& seeds) {
  seeds.add("poses", "plain", "theta,phi\n90,90\n0,45\n-360,0\n720,90.00005\n");
  seeds.add("poses", "quoted",
            "\xef\xbb\xbf\"theta\" , phi,\"a \"\"note\"\"\r\nmore\"\r\n+1, 2,x\r\n\r\n 3 ,4, \"y\"\r");
  for (const char* word : {"theta,phi\n", "\"\"", "\"", "1e308", "nan", "inf", "\r\n", "-0"})
    seeds.add_word("poses", word);
}

void add_names(const Seeds& seeds) {
  seeds.add("dataset_names", "small",
            "ball/0/1/90_90.png\nball/0/1/45_0.jpg\ncube/a b/2/90_90.webp\ncube/a b/2/0_359.PNG\nmanifest.json\n"
            "_extra/ball/0/1/90_90_depth.png\n.DS_Store\nball/Thumbs.db\nempty/\n");
  seeds.add("dataset_names", "forms", "\xc3\xa9/x/1/90_90.png\ne\xcc\x81/y/1/90_90.jpeg\nball/0/1/090_090.png\n");
  for (const char* word : {"90_90.png", "90_90.jpeg", "/1/", "_extra/", "90_90_depth.npy", "desktop.ini", "@eaDir/",
                           "lost+found", ".webp", "360", "-1", "91_0.png", "\xcc\x81"})
    seeds.add_word("dataset_names", word);
}

}  // namespace

void add_documents(const Seeds& seeds) {
  add_configurations(seeds);
  add_cameras(seeds);
  add_poses(seeds);
  add_names(seeds);
}

}  // namespace svnet::fuzz
