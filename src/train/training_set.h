#pragma once
#include <vector>

#include "data/view_dataset.h"
#include "io/views/scores_file.h"
#include "models/sv_net.h"
#include "nn/tensor.h"
#include "train/config/choices.h"
#include "train/view_inputs.h"

namespace svnet::train {

/// The examples that SV-net learns from: (top view of a pose, angles of a view) -> scaled score of the view, in every
/// orientation of the inputs.
class TrainingSet {
 public:
  /// Takes the views of `categories` that have a score. Throws Error unless the rows of the scores are the dataset's
  /// views. Keeps a reference to the inputs.
  TrainingSet(const ViewDataset& dataset, const ViewInputs& inputs, const Scores& scores,
              const std::vector<bool>& categories, Target target, models::AngleEncoding angles);

  Index size() const { return static_cast<Index>(examples_.size()); }

  /// The shape of one example's top view.
  Shape input_shape() const { return inputs_.shape(); }

  struct Batch {
    Tensor top_views;  // (B, …)
    Tensor angles;     // (B, angle_count)
    Tensor targets;    // (B, 1)
  };
  Batch batch(std::span<const std::int32_t> examples) const;

 private:
  struct Example {
    Index input;
    float angles[models::kMostAngles];
    float target;
  };
  const ViewInputs& inputs_;
  models::AngleEncoding angles_;
  std::vector<Example> examples_;
};

}  // namespace svnet::train
