#include "train/stages/gain_check.h"

#include <algorithm>
#include <cmath>

#include "train/selectors.h"

namespace svnet::train {

void add_gains(const ViewDataset& dataset, std::span<const double> predicted, std::span<const double> scores,
               const std::vector<bool>& categories, const GainCalibration& calibration,
               std::vector<CheckedGain>& gains) {
  if (calibration.residuals.empty()) return;
  const std::vector<std::int32_t> best = best_views(dataset, predicted), top = top_views(dataset);
  for (std::size_t p = 0; p < dataset.poses.size(); ++p) {
    const auto b = static_cast<std::size_t>(best[p]), t = static_cast<std::size_t>(top[p]);
    const double gained = scores[b] - scores[t];
    if (!categories[static_cast<std::size_t>(dataset.poses[p].category)] || std::isnan(gained) || b == t) continue;
    gains.push_back({predict::expected_gain(calibration, predict::centred_margin(predicted[b], predicted[t])), gained});
  }
}

GainCheck checked(std::span<const CheckedGain> gains) {
  GainCheck check{.poses = static_cast<Index>(gains.size())};
  constexpr std::size_t kBins = 10;
  std::vector<GainCheck::Bin> bins;
  for (std::size_t i = 0; i < kBins; ++i) bins.push_back({static_cast<double>(i) / kBins, 0, 0, 0});
  for (const CheckedGain& gain : gains) {
    const double is_gain = gain.gained > 0 ? 1 : 0, share = 1 / static_cast<double>(gains.size());
    check.expected += share * gain.said.expected;
    check.gained += share * gain.gained;
    check.inside += share * (gain.gained >= gain.said.low && gain.gained <= gain.said.high ? 1 : 0);
    check.probability += share * gain.said.probability;
    check.positive += share * is_gain;
    auto& bin = bins[std::min(static_cast<std::size_t>(gain.said.probability * kBins), kBins - 1)];
    ++bin.poses;
    bin.probability += gain.said.probability;
    bin.positive += is_gain;
  }
  for (GainCheck::Bin& bin : bins) {
    if (bin.poses == 0) continue;
    bin.probability /= static_cast<double>(bin.poses);
    bin.positive /= static_cast<double>(bin.poses);
    check.bins.push_back(bin);
  }
  return check;
}

}  // namespace svnet::train
