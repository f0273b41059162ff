#include "io/views/camera_file.h"

#include <catch2/catch.hpp>

#include "base/error.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
using namespace svnet::view;

TEST_CASE("a camera is written and read") {
  const TemporaryFolder folder;
  const CameraFile camera{{640, 480, 600.5, 601, 319.5, 240}, look_at({30, 60}, 0.7, {1, 2, 3}, CameraFrame::optical)};
  const CameraFile read = read_camera(folder.write("camera.json", camera_json(camera)));
  CHECK(read.intrinsics.width == 640);
  CHECK(read.intrinsics.fx == 600.5);
  CHECK(read.intrinsics.cy == 240);
  REQUIRE(read.camera_to_world.has_value());
  CHECK(read.camera_to_world->matrix().isApprox(camera.camera_to_world->matrix(), 1e-12));
  CHECK_FALSE(read_camera(folder.write("b.json", camera_json({camera.intrinsics, {}}))).camera_to_world.has_value());
}

TEST_CASE("camera files that cannot be used are named in one line") {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& contents) -> std::string {
    try {
      read_camera(folder.write("c.json", contents));
    } catch (const std::exception& error) {
      return error.what();
    }
    return "read";
  };
  const std::string name = (folder.path() / "c.json").string() + ": ";
  const std::string rest = R"("height": 480, "fx": 600, "fy": 600, "cx": 320, "cy": 240)";
  CHECK(message("{" + rest + "}") == name + "the key 'width' is missing");
  CHECK(message(R"({"width": "a", )" + rest + "}") == name + "width is not a number");
  CHECK(message(R"({"width": 640.5, )" + rest + "}") == name + "width is 640.5, expected a number of pixels");
  CHECK(message(R"({"width": 0, )" + rest + "}") ==
        name + "the image has 0x480 pixels, expected a positive width and height");
  CHECK(message(R"({"width": 300, )" + rest + "}") == name + "cx is 320, which is outside the image of 300 pixels");
  CHECK(message(R"({"width": 640, "f": 1, )" + rest + "}") ==
        name + "the key 'f' is not known; known: width, height, fx, fy, cx, cy, pose");
  CHECK(message("[]") == name + "is no mapping of keys to values, expected a camera");
  CHECK_THAT(message("{"), Catch::StartsWith(name + "is not JSON: "));
  CHECK(message(R"({"width": 640, "pose": {"x_m": 0}, )" + rest + "}") == name + "pose: the key 'y_m' is missing");
  CHECK(message(R"({"width": 640, "pose": {"x_m": 0, "y_m": 0, "z_m": 1, "qx": 0, "qy": 0, "qz": 0, "qw": 2}, )" +
                rest + "}") == name + "pose: the quaternion has length 2, expected 1");
  CHECK(message(R"({"width": 640, "pose": {"x_m": 0, "y_m": 0, "z_m": 1e300, "qx": 1, "qy": 0, "qz": 0, "qw": 0}, )" +
                rest + "}") == name + "pose: z_m is 1e+300, expected metres in the world");
  CHECK(message(R"({"width": 640, "height": 480, "fx": 1e-9, "fy": 600, "cx": 320, "cy": 240})") ==
        name + "fx is 1e-09 for 640 pixels: no camera sees so much; is it in pixels?");
  CHECK(message(R"({"width": 1e7, )" + rest + "}") == name + "width is 1e+07, expected a number of pixels");
  CHECK_THROWS_WITH(read_camera(folder.path()),
                    folder.path().string() + ": cannot be read; expected a JSON or YAML file of a camera");
  CHECK_THROWS_WITH(read_camera(folder.path() / "none"),
                    (folder.path() / "none").string() + ": cannot be read; expected a JSON or YAML file of a camera");
}

namespace {

/// The intrinsics in a file of that contents, "fx fy cx cy of width x height", or the message without the file's name.
std::string intrinsics_in(const std::string& contents) {
  const TemporaryFolder folder;
  const auto path = folder.write("c", contents);
  try {
    const Intrinsics k = read_camera(path).intrinsics;
    return joined(k.fx, ' ', k.fy, ' ', k.cx, ' ', k.cy, " of ", k.width, 'x', k.height);
  } catch (const std::exception& error) {
    const std::string message = error.what(), name = path.string() + ": ";
    return message.starts_with(name) ? message.substr(name.size()) : message;
  }
}

std::string ros_json(const std::string& d, const std::string& rest = "") {
  return R"({"width": 640, "height": 480, "distortion_model": "plumb_bob", "D": )" + d +
         R"(, "K": [600, 0, 319.5, 0, 601, 239.5, 0, 0, 1], "R": [1, 0, 0, 0, 1, 0, 0, 0, 1])" + rest + "}";
}

}  // namespace

TEST_CASE("the camera_info of ROS and the intrinsics of RealSense are read") {
  const std::string expected = "600 601 319.5 239.5 of 640x480";
  CHECK(intrinsics_in(ros_json("[0, 0, 0, 0, 0]")) == expected);
  CHECK(intrinsics_in(ros_json("[]")) == expected);
  CHECK(intrinsics_in(ros_json("[0, 0, 0, 0, 0]", R"(, "P": [600, 0, 319.5, 0, 0, 601, 239.5, 0, 0, 0, 1, 0])")) ==
        expected);
  // rostopic echo; ros2 topic echo writes small letters
  CHECK(intrinsics_in(
            "header:\n  seq: 7\n  stamp: {secs: 1, nsecs: 2}\n  frame_id: \"optical\"\nheight: 480\nwidth: 640\n"
            "distortion_model: \"plumb_bob\"\nD: [0.0, 0.0, 0.0, 0.0, 0.0]\n"
            "K: [600.0, 0.0, 319.5, 0.0, 601.0, 239.5, 0.0, 0.0, 1.0]\nbinning_x: 0\nbinning_y: 0\n"
            "roi:\n  x_offset: 0\n  y_offset: 0\n  height: 0\n  width: 0\n  do_rectify: False\n---\n") == expected);
  CHECK(
      intrinsics_in("height: 480\nwidth: 640\nd:\n- 0.0\n- 0.0\nk:\n- 600.0\n- 0.0\n- 319.5\n- 0.0\n- 601.0\n- 239.5\n"
                    "- 0.0\n- 0.0\n- 1.0\n") == expected);
  // camera_calibration_parsers
  CHECK(intrinsics_in("image_width: 640\nimage_height: 480\ncamera_name: top\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
                      "  data: [600, 0, 319.5, 0, 601, 239.5, 0, 0, 1]\ndistortion_model: plumb_bob\n"
                      "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [0, 0, 0, 0, 0]\n") == expected);
  // rs2_intrinsics
  CHECK(intrinsics_in(R"({"width": 640, "height": 480, "fx": 600, "fy": 601, "ppx": 319.5, "ppy": 239.5,
                          "model": "distortion.inverse_brown_conrady", "coeffs": [0.0, 0.0, 0.0, 0.0, 0.0]})") ==
        expected);
  CHECK(intrinsics_in("width: 640\nheight: 480\nfx: 600\nfy: 601\ncx: 319.5\ncy: 239.5\n") == expected);
}

TEST_CASE("a camera_info with P alone is that of rectified images") {
  CHECK(intrinsics_in(R"({"width": 640, "height": 480, "P": [600, 0, 319.5, -30, 0, 601, 239.5, 0, 0, 0, 1, 0]})") ==
        "600 601 319.5 239.5 of 640x480");
  CHECK(intrinsics_in(R"({"width": 640, "height": 480, "K": [0, 0, 0, 0, 0, 0, 0, 0, 0]})") ==
        "K is 0: the camera is not calibrated");
}

TEST_CASE("a fisheye lens is refused, even if it has no coefficients") {
  CHECK_THAT(intrinsics_in(ros_json("[0, 0, 0, 0]", R"(, "distortion_model": "equidistant")")),
             Catch::StartsWith("distortion_model: 'equidistant' is a fisheye lens; images must be rectified first"));
  CHECK_THAT(intrinsics_in(R"({"width": 640, "height": 480, "fx": 600, "fy": 601, "ppx": 319.5, "ppy": 239.5,
                               "model": "Kannala Brandt4", "coeffs": [0, 0, 0, 0, 0]})"),
             Catch::StartsWith("model: 'Kannala Brandt4' is a fisheye lens"));
  CHECK(intrinsics_in(ros_json("[0, 0, 0, 0]", R"(, "distortion_model": "rational_polynomial")")) ==
        "600 601 319.5 239.5 of 640x480");
}

TEST_CASE("cameras with distortion are refused, and say that images must be rectified") {
  const std::string rectify =
      "; images must be rectified first (ROS: image_proc), and the camera of the rectified images given: no "
      "distortion";
  CHECK(intrinsics_in(ros_json("[0.1, 0, 0, 0, 0]")) == "D: the lens has distortion (0.1)" + rectify);
  CHECK(intrinsics_in(R"({"width": 640, "height": 480, "fx": 600, "fy": 601, "ppx": 319.5, "ppy": 239.5,
                          "coeffs": [0, 0, 0, 0, -0.05]})") == "coeffs: the lens has distortion (-0.05)" + rectify);
  CHECK(intrinsics_in(ros_json("[0]", R"(, "P": [500, 0, 319.5, 0, 0, 601, 239.5, 0, 0, 0, 1, 0])")) ==
        "K and P are different cameras; leave out P if the images are as taken, or give its numbers as K if they are "
        "rectified");
  CHECK(intrinsics_in(ros_json("[0]", R"(, "binning_x": 2)")) ==
        "binning_x is 2; give the camera of the images as they are");
  CHECK_THAT(intrinsics_in(ros_json("[0]", R"(, "Q": 2)")),
             Catch::StartsWith("the key 'Q' is not known; known: width, "));
  CHECK(intrinsics_in(R"({"width": 640, "height": 480, "K": [600, 0, 319.5]})") == "K has 3 numbers, expected 9");
  CHECK(intrinsics_in(R"({"width": 640, "height": 480, "K": 600})") == "K is not a list of numbers");
  CHECK(intrinsics_in(R"({"width": 640, "height": 480, "D": [0]})") == "the key 'K' is missing");
}

TEST_CASE("keys without a value say nothing of a camera") {
  CHECK(intrinsics_in(ros_json("null")) == "600 601 319.5 239.5 of 640x480");
  CHECK(intrinsics_in("width: 640\nheight: 480\nD:\ndistortion_model: ~\nroi: {do_rectify: false}\n"
                      "K: [600, 0, 319.5, 0, 601, 239.5, 0, 0, 1]\n") == "600 601 319.5 239.5 of 640x480");
  // ROS: P of a camera that is not calibrated
  CHECK(intrinsics_in(ros_json("[]", R"(, "P": [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0])")) ==
        "600 601 319.5 239.5 of 640x480");
}

TEST_CASE("a file of camera_calibration_parsers is known by either of its sizes") {
  CHECK(intrinsics_in("image_width: 640\n") == "the key 'image_height' is missing");
  CHECK(intrinsics_in("image_height: 480\ncamera_matrix: [600, 0, 319.5, 0, 601, 239.5, 0, 0, 1]\n") ==
        "the key 'image_width' is missing");
  CHECK(intrinsics_in("image_width: 640\nimage_height: 480\n") == "the key 'camera_matrix' is missing");
}

TEST_CASE("a matrix that is not a pinhole camera's is refused") {
  const auto camera = [](const std::string& k) {
    return intrinsics_in(R"({"width": 640, "height": 480, "K": [)" + k + "]}");
  };
  REQUIRE(camera("600, 0, 319.5, 0, 601, 239.5, 0, 0, 1") == "600 601 319.5 239.5 of 640x480");
  for (const char* k : {"600, 1, 319.5, 0, 601, 239.5, 0, 0, 1", "600, 0, 319.5, 1, 601, 239.5, 0, 0, 1",
                        "600, 0, 319.5, 0, 601, 239.5, 1, 0, 1", "600, 0, 319.5, 0, 601, 239.5, 0, 1, 1",
                        "600, 0, 319.5, 0, 601, 239.5, 0, 0, 2"})
    CHECK(camera(k) == "K is not a pinhole camera's: expected fx 0 cx, 0 fy cy, 0 0 1");
}

TEST_CASE("a K and a P that differ by half a pixel in any number are different cameras") {
  for (const char* p :
       {"600.6, 0, 319.5, 0, 0, 601, 239.5, 0, 0, 0, 1, 0", "600, 0, 320.1, 0, 0, 601, 239.5, 0, 0, 0, 1, 0",
        "600, 0, 319.5, 0, 0, 601.6, 239.5, 0, 0, 0, 1, 0", "600, 0, 319.5, 0, 0, 601, 238.9, 0, 0, 0, 1, 0"})
    CHECK_THAT(intrinsics_in(ros_json("[]", joined(R"(, "P": [)", p, "]"))),
               Catch::StartsWith("K and P are different cameras; leave out P"));
  CHECK(intrinsics_in(ros_json("[]", R"(, "P": [600.4, 0, 319.5, 0, 0, 601, 239.9, 0, 0, 0, 1, 0])")) ==
        "600 601 319.5 239.5 of 640x480");
}
