#include "train/gain_fit.h"

#include <algorithm>

namespace svnet::train {

std::vector<PoseGain> gains_of(const PoseExamples& examples, std::span<const double> predicted) {
  std::vector<PoseGain> gains;
  for (const auto& [begin, end] : pose_ranges(examples.pose)) {
    std::size_t best = begin, top = end;
    for (std::size_t i = begin; i < end; ++i) {
      if (predicted[i] > predicted[best]) best = i;
      if (examples.top[i] != 0) top = i;
    }
    if (top < end && best != top)
      gains.push_back({predicted[best] - predicted[top], examples.y[best] - examples.y[top]});
  }
  return gains;
}

GainCalibration fitted_gain(std::span<const PoseGain> gains) {
  constexpr std::size_t kFewest = 10, kQuantiles = 20;
  if (gains.size() < kFewest) return {};
  const auto count = static_cast<double>(gains.size());
  double margin = 0, gain = 0, squares = 0, products = 0;
  for (const PoseGain& g : gains) margin += g.margin / count, gain += g.gain / count;
  for (const PoseGain& g : gains) {
    squares += (g.margin - margin) * (g.margin - margin);
    products += (g.margin - margin) * (g.gain - gain);
  }
  GainCalibration fit;
  fit.slope = squares > 0 ? std::max(products / squares, 0.0) : 0;
  fit.intercept = gain - fit.slope * margin;
  std::vector<double> residuals;
  for (const PoseGain& g : gains) residuals.push_back(g.gain - fit.intercept - fit.slope * g.margin);
  std::ranges::sort(residuals);
  for (std::size_t i = 0; i <= kQuantiles; ++i)
    fit.residuals.push_back(residuals[i * (residuals.size() - 1) / kQuantiles]);
  return fit;
}

}  // namespace svnet::train
