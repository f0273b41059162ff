#include "train/training_set.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "view/symmetry.h"

namespace svnet::train {

TrainingSet::TrainingSet(const ViewDataset& dataset, const ViewInputs& inputs, const ViewTargets& targets,
                         models::AngleEncoding angles)
    : inputs_(inputs), angles_(angles) {
  for (std::size_t i = 0; i < dataset.views.size(); ++i) {
    const View& view = dataset.views[i];
    if (!std::isfinite(targets.values[i])) continue;
    weighted_ = weighted_ || targets.weights[i] != 1;
    for (int orientation = 0; orientation < inputs.orientations(); ++orientation) {
      Example example{.input = dataset.top_view(view.pose) * inputs.orientations() + orientation,
                      .angles = {},
                      .target = static_cast<float>(targets.values[i]),
                      .root_weight = static_cast<float>(std::sqrt(targets.weights[i]))};
      encode_angles(angles, view::symmetric_theta_deg(orientation, view.theta_deg), view.phi_deg, example.angles);
      examples_.push_back(example);
    }
  }
}

WithinPose TrainingSet::within_pose(std::span<const double> predicted) const {
  struct Group {
    std::vector<double> predicted, targets;
  };
  std::map<Index, Group> groups;
  for (std::size_t i = 0; i < examples_.size(); ++i) {
    Group& group = groups[examples_[i].input];
    group.predicted.push_back(predicted[i]);
    group.targets.push_back(examples_[i].target);
  }
  std::vector<WithinPose> figures;
  for (const auto& [input, group] : groups)
    figures.push_back(within_one_pose(group.predicted, group.targets, std::nullopt));
  return mean_of(figures);
}

TrainingSet::Batch TrainingSet::batch(std::span<const std::int32_t> examples) const {
  const auto count = static_cast<Index>(examples.size());
  const Index angle_size = angle_count(angles_);
  Batch batch{{}, Tensor::empty({count, angle_size}), Tensor::empty({count, 1}), Tensor::empty({count, 1})};
  std::vector<Index> inputs;
  for (Index i = 0; i < count; ++i) {
    const Example& example = examples_[static_cast<std::size_t>(examples[static_cast<std::size_t>(i)])];
    inputs.push_back(example.input);
    std::copy_n(example.angles, angle_size, batch.angles.data<float>() + i * angle_size);
    batch.targets.data<float>()[i] = example.target;
    batch.weights.data<float>()[i] = example.root_weight;
  }
  batch.top_views = inputs_.batch(inputs);
  return batch;
}

}  // namespace svnet::train
