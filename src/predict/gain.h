#pragma once
#include "data/model.h"

namespace svnet::predict {

/// What to expect of moving the camera from above to the best pose, in semantic score (0 to 1), for objects of
/// categories that the model has not seen.
struct Gain {
  double expected;
  double low, high;    ///< four of five gains are between these
  double probability;  ///< that the gain is above 0
};

/// By how much the predicted centred scores differ, from the predicted scores of the best pose and the top view.
double centred_margin(double best_score, double top_score);

/// All 0 for a margin of 0. Throws Error if the calibration is not known.
Gain expected_gain(const GainCalibration& calibration, double margin);

}  // namespace svnet::predict
