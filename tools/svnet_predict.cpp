// svnet-predict: which camera poses show the most of an object, from its top image.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <optional>

#include "command/command.h"
#include "image/oriented.h"
#include "io/files/atomic_file.h"
#include "io/images/depth_file.h"
#include "io/images/image_file.h"
#include "io/views/pose_list_file.h"
#include "predict/prediction_picture.h"
#include "predict/predictor.h"
#include "view/pose_grid.h"

namespace {

using namespace svnet;
using namespace svnet::command;
using svnet::view::CameraPose;

std::string table_text(const std::vector<CameraPose>& poses, const std::vector<float>& scores,
                       const std::vector<std::size_t>& indices) {
  std::ostringstream text;
  text << std::setw(10) << "theta" << std::setw(10) << "phi" << std::setw(12) << "score";
  for (const std::size_t i : indices)
    text << '\n'
         << std::setw(10) << poses[i].theta_deg << std::setw(10) << poses[i].phi_deg << std::setw(12) << std::fixed
         << std::setprecision(6) << scores[i] << std::defaultfloat;
  return text.str();
}

/// What is printed of a top image.
struct Prediction {
  std::vector<CameraPose> poses;
  std::vector<float> scores;
  std::vector<std::size_t> best;  // the best views that differ enough
  float margin_over_top;
  predict::Familiarity familiarity;
};

nlohmann::ordered_json views_json(const Prediction& prediction, const std::vector<std::size_t>& indices) {
  nlohmann::ordered_json views = nlohmann::ordered_json::array();
  for (const std::size_t i : indices) {
    const CameraPose& pose = prediction.poses[i];
    views.push_back({{"theta_deg", pose.theta_deg}, {"phi_deg", pose.phi_deg}, {"score", prediction.scores[i]}});
  }
  return views;
}

std::string json_text(const Prediction& prediction) {
  const nlohmann::ordered_json views = views_json(prediction, predict::best_first(prediction.scores));
  const predict::Familiarity& top_view = prediction.familiarity;
  const nlohmann::ordered_json top{
      {"distance", top_view.distance}, {"limit", top_view.limit}, {"trust", top_view.trust}};
  return nlohmann::ordered_json{{"best", views.front()},
                                {"best_views", views_json(prediction, prediction.best)},
                                {"margin_over_top", prediction.margin_over_top},
                                {"views", views},
                                {"top_view", top}}
      .dump(2);
}

/// The image as it is stored, with a warning if viewers show it turned, or turned as they do.
Image top_image(const std::filesystem::path& path, const std::string& exif, Console& console) {
  io::StoredImage stored = io::read_stored_image(path);
  if (exif == name_of(ExifOrientation::obey)) return oriented(std::move(stored.image), stored.exif_orientation);
  if (stored.exif_orientation != 1)
    console.line(joined(path.string(), ": the EXIF orientation ", stored.exif_orientation,
                        " is ignored; --exif-orientation obey turns the image as viewers do"));
  return std::move(stored.image);
}

}  // namespace

int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  Command command("svnet-predict",
                  "Predicts from an object's top image how much views from candidate camera poses would say about it, "
                  "and prints the poses (theta and phi in degrees) with their scores, best first.",
                  "svnet-predict runs/eth80/model.safetensors --image top.png --plot half-sphere.png");
  fs::path model, image, depth_file, poses_file, plot;
  bool grid = false, json = false;
  Index best = 0;  // 0: not given
  double min_angle_deg = 0;
  std::string exif{name_of(ExifOrientation::ignore)};
  command.add("MODEL", model, "A model that svnet-train wrote (model.safetensors)").required();
  command.add("--image", image, "The object from above: a PNG, JPEG or WebP image of any size")
      .required()
      .value_name("FILE");
  command
      .add("--depth", depth_file,
           "The depth image of the top view (16-bit PNG in millimetres, or .npy in metres), for models that were "
           "trained "
           "with depth")
      .value_name("FILE");
  const Argument poses_option =
      command.add("--poses", poses_file, "The candidates: a CSV file with the header theta,phi");
  poses_option.value_name("FILE");
  command
      .add_flag("--grid", grid, "The paper's candidates: theta every 45 but 270, phi 45, 60, 75; and the top (default)")
      .excludes(poses_option);
  command
      .add("--best", best, "Prints only the K best poses that differ by --min-angle; with --json, best_views has them")
      .value_name("K")
      .positive();
  command
      .add("--min-angle", min_angle_deg,
           "The least angle between two of the best poses, in degrees: 0 to 180, between viewing directions")
      .value_name("DEG")
      .shows_default();
  command
      .add("--exif-orientation", exif, "ignore: takes pixels as stored; obey: turns them as the EXIF orientation says")
      .one_of(names_of<ExifOrientation>())
      .shows_default();
  command.add_flag(
      "--json", json,
      "Prints JSON: best; best_views, of --best and --min-angle; margin_over_top, the best score minus that of the "
      "top view; views with theta_deg, phi_deg, score, best first; and top_view: how far its shape is "
      "from those that the model was trained on (distance, limit), and the share that it counts (trust)");
  command
      .add("--plot", plot,
           "Writes a PNG image: the top image with the object's axis, and the half-sphere from above as it lies in the "
           "top image, with the top view in the centre, theta 0 to the left and 90 down; dots from dark blue (lowest "
           "score) to yellow, the best ringed in red. With /dev/stdout no scores are printed")
      .value_name("FILE");
  return command.run(argc, argv, [&](Console& console) {
    if (!plot.empty()) check_can_be_written(plot, {model, image, depth_file, poses_file}, io::Streams::allowed);
    const std::vector<CameraPose> poses = poses_file.empty() ? view::paper_grid() : io::read_pose_list(poses_file);
    const predict::Predictor predictor(model, inference_options_from_environment());
    std::optional<DepthImage> depth;
    if (!depth_file.empty()) depth = io::read_depth(depth_file);
    if (depth && !predictor.uses_depth()) console.line("--depth is ignored: the model was trained without depth");
    check(depth || !predictor.uses_depth(), model.string(),
          ": was trained with depth; give the depth image of the top view by --depth");
    const Image top = top_image(image, exif, console);
    const Tensor features = predictor.embed(top, depth ? &*depth : nullptr);
    const auto familiarity = predictor.familiarity(features);
    if (familiarity.trust < 1)
      console.line(joined(image.string(),
                          ": the object's shape is unlike those that the model was trained on: distance ",
                          familiarity.distance, ", theirs are up to ", familiarity.limit, "; the shape counts ",
                          std::lround(100 * familiarity.trust), " %, the rest is what holds for every object"));
    const std::vector<float> scores = predictor.scores(features, poses);
    const float top_score = predictor.scores(features, std::span(&view::kTopView, 1))[0];
    std::vector<std::size_t> chosen(std::min(static_cast<std::size_t>(std::max<Index>(best, 1)), poses.size()));
    chosen.resize(predict::best_views(scores, poses, min_angle_deg, chosen));
    const Prediction prediction{poses, scores, chosen, scores[chosen[0]] - top_score, familiarity};
    if (!plot.empty()) io::write_png(plot, predict::prediction_picture(top, depth ? &*depth : nullptr, poses, scores));
    if (!io::is_standard_output(plot))
      console.result(json ? json_text(prediction)
                          : table_text(poses, scores, best > 0 ? chosen : predict::best_first(scores)));
  });
}
