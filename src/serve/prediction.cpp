#include "serve/prediction.h"

#include <nlohmann/json.hpp>

#include "image/oriented.h"
#include "io/images/depth_file.h"
#include "io/images/image_codecs.h"
#include "io/images/image_file.h"
#include "predict/familiarity_note.h"

namespace svnet::serve {
namespace {

using Json = nlohmann::ordered_json;

io::Bytes bytes_of(std::string_view text) { return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}; }

Image top_image(io::Bytes file, ExifOrientation exif, Json& notes) {
  io::StoredImage stored = io::decode_stored_image("image", file);
  switch (exif) {
    case ExifOrientation::obey:
      return oriented(std::move(stored.image), stored.exif_orientation);
    case ExifOrientation::ignore:
      break;
  }
  if (stored.exif_orientation != 1)
    notes.push_back(joined("the EXIF orientation ", stored.exif_orientation,
                           " is ignored; exif_orientation=obey turns the image as viewers do"));
  return std::move(stored.image);
}

Json pose_json(const view::CameraPose& pose, float score) {
  return {{"theta_deg", pose.theta_deg}, {"phi_deg", pose.phi_deg}, {"score", score}};
}

}  // namespace

Json prediction_json(const predict::Predictor& predictor, const PredictionRequest& request, std::string_view image,
                     std::string_view depth) {
  const io::Bytes file = bytes_of(image);
  expect(io::image_format(file) != io::ImageFormat::other, 415, "the image is not a PNG, JPEG or WebP file",
         io::recognised_instead(file));
  check(!depth.empty() || !predictor.uses_depth(),
        "the model was trained with depth; send the depth image of the top view too, as the part 'depth' of a form");
  Json notes = Json::array();
  if (!depth.empty() && !predictor.uses_depth())
    notes.push_back("depth is ignored: the model was trained without depth");
  std::optional<DepthImage> measured;
  if (predictor.uses_depth()) measured = io::decode_depth("depth", bytes_of(depth), request.depth_unit_m);
  const Image top = top_image(file, request.exif, notes);
  const Tensor features = predictor.embed(top, measured ? &*measured : nullptr);
  const auto familiarity = predictor.familiarity(features);
  if (std::string note = predict::familiarity_note(familiarity); !note.empty()) notes.push_back(std::move(note));
  const std::vector<float> scores = predictor.scores(features, request.poses);
  Json views = Json::array();
  for (const std::size_t i : predict::best_first(scores)) views.push_back(pose_json(request.poses[i], scores[i]));
  const std::size_t best_index = predict::best_view(scores);
  Json best = pose_json(request.poses[best_index], scores[best_index]);
  best["camera_pose"] = camera_pose_json(request.poses[best_index], request.place);
  return {
      {"best", std::move(best)},
      {"views", std::move(views)},
      {"top_view", {{"distance", familiarity.distance}, {"limit", familiarity.limit}, {"trust", familiarity.trust}}},
      {"notes", std::move(notes)}};
}

}  // namespace svnet::serve
