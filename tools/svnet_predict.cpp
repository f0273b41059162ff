// svnet-predict: which camera poses show the most of an object, from its top image.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/progress.h"
#include "command/command.h"
#include "image/oriented.h"
#include "io/files/atomic_file.h"
#include "io/files/make_folder.h"
#include "io/images/depth_file.h"
#include "io/images/image_file.h"
#include "io/views/pose_list_file.h"
#include "predict/familiarity_note.h"
#include "predict/prediction_picture.h"
#include "predict/prediction_text.h"
#include "predict/predictor.h"
#include "predict/taken_views.h"
#include "predict/top_images.h"
#include "view/pose_grid.h"

namespace {

using namespace svnet;
using namespace svnet::command;
using svnet::view::CameraPose;

struct Arguments {
  std::filesystem::path model, image, depth_file, poses_file, plot;
  bool json = false, gain = false, has_candidates = false;  // has_candidates: --poses or --grid
  Index best = 0;                                           // 0: not given
  double min_angle_deg = 0;
  std::vector<std::string> taken;
  std::string exif{name_of(ExifOrientation::ignore)};
};

/// The image as it is stored, with a warning if viewers show it turned, or turned as they do.
Image top_image(const std::filesystem::path& path, const std::string& exif, Console& console) {
  io::StoredImage stored = io::read_stored_image(path);
  if (exif == name_of(ExifOrientation::obey)) return oriented(std::move(stored.image), stored.exif_orientation);
  if (stored.exif_orientation != 1)
    console.line(joined(path.string(), ": the EXIF orientation ", stored.exif_orientation,
                        " is ignored; --exif-orientation obey turns the image as viewers do"));
  return std::move(stored.image);
}

/// Predicts for one top image, and writes its picture if `plot` is not empty.
class PredictCommand {
 public:
  PredictCommand(const Arguments& arguments, Console& console)
      : a_(arguments),
        console_(console),
        candidates_(a_.poses_file.empty() ? view::paper_grid() : io::read_pose_list(a_.poses_file)),
        predictor_(a_.model, inference_options_from_environment()) {
    for (const std::string& text : a_.taken) {
      const TakenPicture taken = taken_picture(text);
      taken_.push_back({taken.pose, frame::view_shape(top_image(taken.picture, a_.exif, console_))});
    }
    check(taken_.empty() || predictor_.knows_next_view(), a_.model.string(),
          ": does not know which view to take next; train it with sv_net.next_view: ridge");
    if (!taken_.empty()) leave_out_taken();
  }

  Prediction predict(const TopImage& from, const std::filesystem::path& plot) const {
    std::optional<DepthImage> depth;
    if (!from.depth.empty() && predictor_.uses_depth()) depth = io::read_depth(from.depth);
    check(depth || !predictor_.uses_depth(), a_.model.string(),
          ": was trained with depth; give the depth image of the top view by --depth",
          from.views.empty() ? "" : ", or as _extra/…/90_90_depth.png of the data set");
    const Image top = top_image(from.image, a_.exif, console_);
    const Tensor features = predictor_.embed(top, depth ? &*depth : nullptr);
    const bool has_views = !from.views.empty() && !a_.has_candidates;
    const std::vector<CameraPose>& poses = has_views ? from.poses : candidates_;
    if (!taken_.empty()) return next_prediction(top, features, plot);
    const std::vector<float> scores = predictor_.scores(features, poses);
    const float top_score = predictor_.scores(features, std::span(&view::kTopView, 1))[0];
    std::vector<std::size_t> chosen(std::min(static_cast<std::size_t>(std::max<Index>(a_.best, 1)), poses.size()));
    chosen.resize(predict::best_views(scores, poses, a_.min_angle_deg, chosen));
    const auto familiarity = predictor_.familiarity(features);
    if (const std::string note = predict::familiarity_note(familiarity); !note.empty())
      console_.line(from.image.string() + ": " + note);
    if (!plot.empty()) {
      std::optional<Image> view;
      if (has_views) view = top_image(from.views[chosen[0]], a_.exif, console_);
      io::write_png(
          plot, predict::prediction_picture(top, depth ? &*depth : nullptr, poses, scores, view ? &*view : nullptr));
    }
    std::optional<predict::Gain> gain;
    if (a_.gain || predictor_.knows_gain())
      gain = predictor_.gain(static_cast<double>(scores[chosen[0]]), static_cast<double>(top_score));
    return {poses, scores, chosen, scores[chosen[0]] - top_score, gain, familiarity};
  }

  std::string text_of(const Prediction& prediction, const std::vector<std::size_t>& indices) const {
    return table_text(prediction, indices) + (a_.gain ? "\n" + gain_text(*prediction.gain) : "");
  }

  void predict_image() const {
    if (!a_.plot.empty())
      check_can_be_written(a_.plot, {a_.model, a_.image, a_.depth_file, a_.poses_file}, io::Streams::allowed);
    if (!a_.depth_file.empty() && !predictor_.uses_depth())
      console_.line("--depth is ignored: the model was trained without depth");
    const Prediction prediction = predict({.name = {}, .image = a_.image, .depth = a_.depth_file}, a_.plot);
    if (io::is_standard_output(a_.plot)) return;
    console_.result(a_.json ? prediction_json(prediction).dump(2) : text_of(prediction, printed(prediction)));
  }

  void predict_folder() const {
    const std::vector<TopImage> images = top_images(a_.image, a_.depth_file);
    if (!a_.plot.empty()) io::make_folder(a_.plot);
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    Progress progress(console_.messages(), "top images", static_cast<Index>(images.size()));
    for (const TopImage& image : images) {
      std::string picture = image.name.substr(0, image.name.find_last_of('.')) + ".png";
      std::ranges::replace(picture, '/', '_');
      const Prediction prediction = predict(image, a_.plot.empty() ? a_.plot : a_.plot / picture);
      if (a_.json) {
        nlohmann::ordered_json one{{"image", image.name}};
        one.update(prediction_json(prediction));
        all.push_back(std::move(one));
      } else {
        console_.result(image.name + "\n" +
                        text_of(prediction, a_.best > 0 ? prediction.best : std::vector{prediction.best[0]}));
      }
      progress.update(&image - images.data() + 1);
    }
    if (a_.json) console_.result(nlohmann::ordered_json{{"images", all}}.dump(2));
  }

 private:
  /// Candidates that are apart from the views taken.
  void leave_out_taken() {
    std::erase_if(candidates_,
                  [&](const CameraPose& pose) { return !predict::is_apart(pose, taken_, a_.min_angle_deg); });
    check(!candidates_.empty(), "no candidate differs enough from the views of --taken; give others by --poses",
          a_.min_angle_deg > 0 ? ", or a smaller --min-angle" : "");
  }

  /// Which view to take next.
  Prediction next_prediction(const Image& top, const Tensor& features, const std::filesystem::path& plot) const {
    const std::vector<float> scores = predictor_.next_scores(features, taken_, candidates_);
    if (!plot.empty()) io::write_png(plot, predict::prediction_picture(top, nullptr, candidates_, scores, nullptr));
    return {candidates_, scores, {predict::best_view(scores)}, {}, {}, predictor_.familiarity(features)};
  }

  std::vector<std::size_t> printed(const Prediction& prediction) const {
    return a_.best > 0 ? prediction.best : predict::best_first(prediction.scores);
  }

  const Arguments& a_;
  Console& console_;
  std::vector<CameraPose> candidates_;
  predict::Predictor predictor_;
  std::vector<frame::TakenView> taken_{};
};

}  // namespace

int main(int argc, char** argv) {
  Command command("svnet-predict",
                  "Predicts from an object's top image how much views from candidate camera poses would say about it, "
                  "and prints the poses (theta and phi in degrees) with their scores, best first.",
                  "svnet-predict runs/eth80/model.safetensors --image top.png --plot half-sphere.png");
  Arguments a;
  bool grid = false;
  command.add("MODEL", a.model, "A model that svnet-train wrote (model.safetensors)").required();
  command
      .add("--image", a.image,
           "The object from above: a PNG, JPEG or WebP image of any size. Or a folder: of such images, or a data set, "
           "whose "
           "top views are taken; its other views are then the candidates, unless --poses or --grid is given")
      .required()
      .value_name("FILE|FOLDER");
  command
      .add("--depth", a.depth_file,
           "The depth image of the top view (16-bit PNG in millimetres, or .npy in metres), for models that were "
           "trained with depth. Or, for a folder of images, the folder of files with the same names")
      .value_name("FILE");
  const Argument poses_option =
      command.add("--poses", a.poses_file, "The candidates: a CSV file with the header theta,phi");
  poses_option.value_name("FILE");
  command
      .add_flag("--grid", grid, "The paper's candidates: theta every 45 but 270, phi 45, 60, 75; and the top (default)")
      .excludes(poses_option);
  command
      .add("--views,--best", a.best,
           "Prints only K poses to take together, each judged by its score and by how far it is from the others; with "
           "--json, best_views has them")
      .value_name("K")
      .positive();
  command
      .add("--min-angle", a.min_angle_deg,
           "The least angle between two of the poses of --views, in degrees: 0 to 180, between viewing directions")
      .value_name("DEG")
      .shows_default();
  command
      .add(
          "--taken", a.taken,
          "A view that was taken, by its pose and its picture, such as 45,60=view.png; may be repeated. The scores are "
          "then those of the next view, beside these: the candidates without those taken, or within --min-angle of "
          "them. For models that were trained with sv_net.next_view")
      .value_name("THETA,PHI=FILE");
  command.add_flag("--gain", a.gain,
                   "Also prints what moving the camera from the top view to the best pose is expected to gain, with an "
                   "interval that holds four of five cases, for objects of categories that the model has not seen");
  command
      .add("--exif-orientation", a.exif,
           "ignore: takes pixels as stored; obey: turns them as the EXIF orientation says")
      .one_of(names_of<ExifOrientation>())
      .shows_default();
  command.add_flag(
      "--json", a.json,
      "Prints JSON: best; best_views, of --views and --min-angle; margin_over_top, the best score minus that of the "
      "top view; views with theta_deg, phi_deg, score, best first; gain: expected, low, high, probability, if the "
      "model knows; and top_view: how far its shape is "
      "from those that the model was trained on (distance, limit), and the share that it counts (trust). For a folder, "
      "images: a list of these with the name of the image");
  command
      .add("--plot", a.plot,
           "Writes a PNG image: the top image with the object's axis, and the half-sphere from above as it lies in the "
           "top image, with the top view in the centre, theta 0 to the left and 90 down; dots from dark blue (lowest "
           "score) to yellow, the best ringed in red. With /dev/stdout no scores are printed. For a "
           "folder of images, a folder, with a picture of each; those of a data set show the view that was chosen, too")
      .value_name("FILE");
  return command.run(argc, argv, [&](Console& console) {
    a.has_candidates = grid || !a.poses_file.empty();
    if (!a.taken.empty() && (a.best > 0 || a.gain || std::filesystem::is_directory(a.image)))
      wrong_usage(
          "--taken says which view of one object to take next: it goes with neither --views, --gain nor a folder");
    const PredictCommand predict_command(a, console);
    if (std::filesystem::is_directory(a.image))
      predict_command.predict_folder();
    else
      predict_command.predict_image();
  });
}
