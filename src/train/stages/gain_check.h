#pragma once
#include <span>
#include <vector>

#include "data/model.h"
#include "data/view_dataset.h"
#include "predict/gain.h"

namespace svnet::train {

/// What a model said that moving the camera would gain in a pose of a category it had not seen, and what it gained.
struct CheckedGain {
  predict::Gain said;
  double gained;
};

/// Adds the poses of `categories` whose views have scores, unless the top view is the best predicted one; none if the
/// calibration is not known.
void add_gains(const ViewDataset& dataset, std::span<const double> predicted, std::span<const double> scores,
               const std::vector<bool>& categories, const GainCalibration& calibration,
               std::vector<CheckedGain>& gains);

/// How the gains of many poses agree with what was said.
struct GainCheck {
  Index poses = 0;
  double expected = 0, gained = 0;       ///< means
  double inside = 0;                     ///< the share within the interval that should hold 80 %
  double probability = 0, positive = 0;  ///< mean of what was said, and the share above 0
  /// By what was said: in steps of a tenth, those that occurred.
  struct Bin {
    double from;
    Index poses;
    double probability, positive;
  };
  std::vector<Bin> bins{};
};
GainCheck checked(std::span<const CheckedGain> gains);

}  // namespace svnet::train
