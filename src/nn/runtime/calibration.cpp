#include "nn/runtime/calibration.h"

#include <algorithm>
#include <cmath>

#include "base/finite.h"

namespace svnet {

void Calibration::Seen::add(Index count, const kernels::PanelRows& a, Index channels) {
  const auto size = static_cast<std::size_t>(channels);
  low.resize(size);  // 0 is in every range
  high.resize(size);
  sum.resize(size);
  rows += count;
  for (Index begin = 0; begin < channels; begin += a.run) {
    const float* block = a.data + begin / a.run * a.block_stride;
    const Index run = std::min(a.run, channels - begin);
    float *run_low = low.data() + begin, *run_high = high.data() + begin;
    double* run_sum = sum.data() + begin;
    for (Index r = 0; r < count; ++r) {
      const float* row = block + r * a.row_stride;
      for (Index i = 0; i < run; ++i) {
        run_low[i] = std::min(run_low[i], row[i]);
        run_high[i] = std::max(run_high[i], row[i]);
        run_sum[i] += static_cast<double>(row[i]);
      }
    }
  }
}

Calibration::Calibration(const Graph& graph, const Parameters& parameters, NodeId output)
    : network_(graph, parameters, output, {.observable = true}) {}

void Calibration::add(const Tensor& batch) {
  check(batch.defined() && batch.size() > 0, "[calibration] there are no pictures");
  check(!first_not_finite(batch.values<float>()), "[calibration] a picture has values that are not finite");
  network_.observe({batch}, [&](const std::string& layer, Index rows, const kernels::PanelRows& a, Index channels) {
    seen_[layer].add(rows, a, channels);
  });
}

ActivationRanges Calibration::ranges() const {
  check(!seen_.empty(), "[calibration] there are no pictures, or the network has nothing that int8 multiplies");
  ActivationRanges ranges;
  for (const auto& [layer, seen] : seen_) {
    std::vector<float> mean;
    for (const double sum : seen.sum) mean.push_back(static_cast<float>(sum / static_cast<double>(seen.rows)));
    // NaN is in no minimum and no maximum, but in the mean.
    check(!first_not_finite(mean) && !first_not_finite(seen.low) && !first_not_finite(seen.high),
          "[calibration] an input of layer ", layer, " is not finite: the weights do not fit this network");
    ranges[layer] = {seen.low, seen.high, std::move(mean)};
  }
  return ranges;
}

}  // namespace svnet
