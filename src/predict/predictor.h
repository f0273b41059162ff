#pragma once
#include <filesystem>
#include <span>
#include <vector>

#include "image/image.h"
#include "io/model_file.h"
#include "nn/runtime/inference.h"
#include "view/pose.h"

namespace svnet {

/// A trained model, ready to say which views of an object are worth taking: a top image becomes features once, and
/// features with a camera pose become a score in [0, 1]. Safe to use from several threads at once.
class Predictor {
 public:
  /// Throws Error that names the file and what is wrong with it.
  explicit Predictor(const std::filesystem::path& model_file);
  explicit Predictor(const Model& model);

  /// The number D of features: of all orientations of the top image that the model looks at.
  Index feature_count() const { return feature_count_; }

  /// Features (1, D) of a top image of any size. Throws Error for an image without pixels, or whose rgb has another
  /// size than its height and width say, and where a feature is not finite.
  Tensor embed(const Image& top) const;

  /// One score per pose, in order. Poses a whole turn apart have the same score. Throws Error unless features are
  /// (1, D) finite f32, and every pose is in range (view/pose.h). A score does not depend on the
  /// poses that it is asked for together with.
  std::vector<float> scores(const Tensor& features, std::span<const Pose> poses) const;

 private:
  Preprocessing preprocessing_;
  AngleEncoding angles_;
  int orientations_;
  Index feature_count_;
  Inference backbone_, head_;
};

/// The number of the highest score, the first among equals. Throws Error where there is none.
std::size_t best_view(std::span<const float> scores);

/// The numbers of all scores, best first, equal ones in their order.
std::vector<std::size_t> best_first(std::span<const float> scores);

}  // namespace svnet
