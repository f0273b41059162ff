#pragma once
#include <filesystem>
#include <span>
#include <vector>

#include "image/image.h"
#include "io/models/model_file.h"
#include "nn/runtime/inference.h"
#include "predict/score_head.h"
#include "view/camera_pose.h"

namespace svnet {

/// A trained model, ready to say which views of an object are worth taking: a top image becomes features once, and
/// features with a camera pose become a score in [0, 1]. Safe to use from several threads at once.
class Predictor {
 public:
  /// Throws Error that names the file and what is wrong with it.
  explicit Predictor(const std::filesystem::path& model_file);
  explicit Predictor(const Model& model);

  /// The number D of features: over all symmetries of the top image that the model sees.
  Index feature_count() const { return head_.feature_count(); }

  /// Features (1, D) of a top image of any size. Throws Error for an image without pixels, or whose rgb has another
  /// size than its height and width say, and where a feature is not finite.
  Tensor embed(const Image& top) const;

  /// As ScoreHead::scores, of features that embed returned.
  std::vector<float> scores(const Tensor& features, std::span<const CameraPose> poses) const;

 private:
  Preprocessing preprocessing_;
  int symmetries_;
  Inference backbone_;
  ScoreHead head_;
};

/// The number of the highest score, the first among equals. Throws Error where there is none.
std::size_t best_view(std::span<const float> scores);

/// The numbers of all scores, best first, equal ones in their order.
std::vector<std::size_t> best_first(std::span<const float> scores);

}  // namespace svnet
