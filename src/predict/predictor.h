#pragma once
#include <filesystem>
#include <span>
#include <vector>

#include "image/image.h"
#include "io/models/model_file.h"
#include "nn/runtime/inference.h"
#include "predict/score_head.h"
#include "view/camera_pose.h"

namespace svnet::predict {

/// A trained model for inference. A top image becomes features once; features and a camera pose become a score in
/// [0, 1]. Thread-safe.
class Predictor {
 public:
  /// Throws Error that names the file and says what is wrong.
  explicit Predictor(const std::filesystem::path& model_file, const InferenceOptions& options = {});
  explicit Predictor(const Model& model, const InferenceOptions& options = {});

  /// The number D of features: over all symmetries of the top image that the model sees.
  Index feature_count() const { return head_.feature_count(); }

  /// Features (1, D) of a top image of any size. Throws Error for an image without pixels, if rgb does not have height
  /// x width x 3 elements, and if a feature is not finite.
  Tensor embed(const Image& top) const;

  /// ScoreHead::scores of features that embed has returned.
  std::vector<float> scores(const Tensor& features, std::span<const view::CameraPose> poses) const;

 private:
  models::Preprocessing preprocessing_;
  int symmetries_;
  Inference backbone_;
  ScoreHead head_;
};

/// The index of the highest score, the first of equal ones. Throws Error if there are no scores.
std::size_t best_view(std::span<const float> scores);

/// The indices of all scores, highest score first; equal scores keep their order.
std::vector<std::size_t> best_first(std::span<const float> scores);

}  // namespace svnet::predict
