#pragma once
#include <span>
#include <vector>

#include "data/model.h"
#include "train/pose_examples.h"

namespace svnet::train {

/// What moving from the top view to the best predicted view would gain in one pose.
struct PoseGain {
  double margin;  ///< predicted: the best centred score minus that of the top view
  double gain;    ///< of the scores themselves
};

/// Of each pose with a top view, unless that is the best predicted view. `predicted`: the centred score of each
/// example. Requires examples.top.
std::vector<PoseGain> gains_of(const PoseExamples& examples, std::span<const double> predicted);

/// Gains by a line, whose slope is not negative, and the quantiles of what it leaves over. Not known for fewer than ten
/// poses.
GainCalibration fitted_gain(std::span<const PoseGain> gains);

}  // namespace svnet::train
