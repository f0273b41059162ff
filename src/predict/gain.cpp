#include "predict/gain.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/quantile.h"
#include "models/pose_head.h"

namespace svnet::predict {
namespace {

double logit(double score) {
  constexpr double kLeast = 1e-9;
  const double inside = std::clamp(score, kLeast, 1 - kLeast);
  return std::log(inside / (1 - inside));
}

/// The share of a distribution above `value`, linearly between its quantiles.
double share_above(const std::vector<double>& quantiles, double value) {
  const auto above = std::ranges::upper_bound(quantiles, value);
  if (above == quantiles.begin()) return 1;
  if (above == quantiles.end()) return 0;
  const double low = *(above - 1), part = (value - low) / (*above - low);
  return 1 - (static_cast<double>(above - quantiles.begin() - 1) + part) / static_cast<double>(quantiles.size() - 1);
}

}  // namespace

double centred_margin(double best_score, double top_score) {
  return (logit(best_score) - logit(top_score)) / models::kLogitPerScore;
}

Gain expected_gain(const GainCalibration& calibration, double margin) {
  check(calibration.residuals.size() >= 2,
        "[predict] the model does not say what moving the camera gains: it was made by an earlier version, or in the "
        "frame camera; train one in another frame (sv_net.frame)");
  if (margin == 0) return {0, 0, 0, 0};  // the top view is the best: there is no move
  const double fitted = calibration.intercept + calibration.slope * margin;
  return {.expected = fitted,
          .low = fitted + quantile(calibration.residuals, 0.1),
          .high = fitted + quantile(calibration.residuals, 0.9),
          .probability = share_above(calibration.residuals, -fitted)};
}

}  // namespace svnet::predict
