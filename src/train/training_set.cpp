#include "train/training_set.h"

#include <algorithm>
#include <cmath>

#include "semantics/score_sums.h"
#include "train/dataset_rows.h"
#include "view/symmetry.h"

namespace svnet::train {
namespace {

/// The score that SV-net learns, scaled to [0, 1] among the views of each pose.
std::vector<double> scaled_targets(const ViewDataset& dataset, const Scores& scores, Target target) {
  if (target == Target::individual) return scores.scaled;
  return semantics::scaled_per_pose(scores.global, dataset.pose_of_view());
}

}  // namespace

TrainingSet::TrainingSet(const ViewDataset& dataset, const ViewInputs& inputs, const Scores& scores,
                         const std::vector<bool>& categories, Target target, models::AngleEncoding angles)
    : inputs_(inputs), angles_(angles) {
  check_rows(dataset, scores.paths, "scores");
  const std::vector<double> targets = scaled_targets(dataset, scores, target);
  for (std::size_t i = 0; i < dataset.views.size(); ++i) {
    const View& view = dataset.views[i];
    if (!categories[static_cast<std::size_t>(view.category)] || !std::isfinite(targets[i])) continue;
    for (int orientation = 0; orientation < inputs.orientations(); ++orientation) {
      Example example{.input = dataset.top_view(view.pose) * inputs.orientations() + orientation,
                      .angles = {},
                      .target = static_cast<float>(targets[i])};
      encode_angles(angles, view::symmetric_theta_deg(orientation, view.theta_deg), view.phi_deg, example.angles);
      examples_.push_back(example);
    }
  }
}

TrainingSet::Batch TrainingSet::batch(std::span<const std::int32_t> examples) const {
  const auto count = static_cast<Index>(examples.size());
  const Index angle_size = angle_count(angles_);
  Batch batch{{}, Tensor::empty({count, angle_size}), Tensor::empty({count, 1})};
  std::vector<Index> inputs;
  for (Index i = 0; i < count; ++i) {
    const Example& example = examples_[static_cast<std::size_t>(examples[static_cast<std::size_t>(i)])];
    inputs.push_back(example.input);
    std::copy_n(example.angles, angle_size, batch.angles.data<float>() + i * angle_size);
    batch.targets.data<float>()[i] = example.target;
  }
  batch.top_views = inputs_.batch(inputs);
  return batch;
}

}  // namespace svnet::train
