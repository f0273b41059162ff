#pragma once
#include <vector>

#include "data/view_dataset.h"
#include "models/sv_net.h"
#include "nn/tensor.h"
#include "train/view_inputs.h"
#include "train/view_targets.h"
#include "train/within_pose.h"

namespace svnet::train {

/// The examples that SV-net learns from: (top view of a pose, angles of a view) -> target of the view, in every
/// orientation of the inputs.
class TrainingSet {
 public:
  /// Takes the views that have a target. Keeps a reference to the inputs.
  TrainingSet(const ViewDataset& dataset, const ViewInputs& inputs, const ViewTargets& targets,
              models::AngleEncoding angles);

  Index size() const { return static_cast<Index>(examples_.size()); }

  /// The shape of one example's top view.
  Shape input_shape() const { return inputs_.shape(); }

  struct Batch {
    Tensor top_views;  // (B, …)
    Tensor angles;     // (B, angle_count)
    Tensor targets;    // (B, 1)
    Tensor weights;    // (B, 1): the square roots of the targets' weights
  };
  Batch batch(std::span<const std::int32_t> examples) const;

  /// Whether a target has another weight than 1.
  bool weighted() const { return weighted_; }

  /// How well predicted scores, one per example, order the targets of each top view in each orientation.
  WithinPose within_pose(std::span<const double> predicted) const;

 private:
  struct Example {
    Index input;
    float angles[models::kMostAngles];
    float target, root_weight;
  };
  const ViewInputs& inputs_;
  models::AngleEncoding angles_;
  std::vector<Example> examples_;
  bool weighted_ = false;
};

}  // namespace svnet::train
