#pragma once
#include <functional>
#include <string>
#include <vector>

#include "data/model.h"
#include "data/model_part.h"
#include "image/image.h"
#include "view/camera_pose.h"

// Whether an exported model computes what the model computes that it was made from.
namespace svnet::exports {

/// What both are given.
struct Sample {
  Image picture;
  std::vector<view::CameraPose> poses;
  /// Of the head of a model in the frame `camera`: (1, D), of the picture. Of other heads, that of the next view
  /// included: inputs (M, I).
  Tensor features{}, pose_inputs{};
};

/// The values that an exported part gives for a sample: scores of the poses, or features of the picture.
using ExportedPart = std::function<std::vector<float>(const Sample&)>;

struct Agreement {
  Index samples = 0, poses = 0;
  /// Of scores; of features, relative to the largest one.
  double largest_difference = 0;
  Index same_best = 0;  ///< samples of which both choose the same pose

  /// "4 pictures x 20 poses: largest difference 1.2e-07 (bound 1e-05), the same best pose in 4 of 4".
  std::string text(double bound) const;
};

/// Compares on a few generated pictures and poses, the same in every call. `name` begins the errors. Throws Error if a
/// difference is larger than `bound`, or a number of values differs.
Agreement agreement(const std::string& name, const Model& model, ModelPart part, const ExportedPart& exported,
                    double bound);

/// Throws Error that says which part to export unless the model has `part` (data/model_part.h).
void check_part(const Model& model, ModelPart part);

/// The picture (1, H, W, 3) as the backbone takes it; `raw`: resized only, with values 0 to 255.
Tensor network_picture(const Model& model, const Image& picture, bool raw);

/// The largest difference of scores that an export may have: 1e-5 in f32, 5e-3 in bf16, 2e-2 in int8.
double bound_of(StoredPrecision precision);

}  // namespace svnet::exports
