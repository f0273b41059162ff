#include "nn/runtime/calibration.h"

#include <algorithm>
#include <cmath>

#include "base/finite.h"

namespace svnet {
namespace {

/// Adds the rows (rows, channels) to ranges, whose `mean` holds sums, in order.
void add_rows(Index rows, const kernels::PanelRows& a, Index channels, kernels::ChannelRanges& ranges) {
  const auto size = static_cast<std::size_t>(channels);
  ranges.low.resize(size);  // 0 is in every range
  ranges.high.resize(size);
  ranges.mean.resize(size);
  for (Index begin = 0; begin < channels; begin += a.run) {
    const float* block = a.data + begin / a.run * a.block_stride;
    const Index count = std::min(a.run, channels - begin);
    float *low = ranges.low.data() + begin, *high = ranges.high.data() + begin;
    double* sum = ranges.mean.data() + begin;
    for (Index r = 0; r < rows; ++r) {
      const float* row = block + r * a.row_stride;
      for (Index i = 0; i < count; ++i) {
        low[i] = std::min(low[i], row[i]);
        high[i] = std::max(high[i], row[i]);
        sum[i] += static_cast<double>(row[i]);
      }
    }
  }
}

}  // namespace

Calibration::Calibration(const Graph& graph, const Parameters& parameters, NodeId output)
    : network_(graph, parameters, output, {.observable = true}) {}

void Calibration::add(const Tensor& batch) {
  check(batch.defined() && batch.size() > 0, "[calibration] there are no pictures");
  check(!first_not_finite(batch.values<float>()), "[calibration] a picture has values that are not finite");
  network_.observe({batch}, [&](const std::string& layer, Index rows, const kernels::PanelRows& a, Index channels) {
    add_rows(rows, a, channels, sums_[layer]);
    rows_[layer] += rows;
  });
}

ActivationRanges Calibration::ranges() const {
  check(!sums_.empty(), "[calibration] there are no pictures, or the network has no products that int8 multiplies");
  ActivationRanges result = sums_;
  for (auto& [layer, of_layer] : result)
    for (std::size_t i = 0; i < of_layer.mean.size(); ++i) {
      of_layer.mean[i] /= static_cast<double>(rows_.at(layer));
      check(std::isfinite(of_layer.mean[i]) && std::isfinite(of_layer.low[i]) && std::isfinite(of_layer.high[i]),
            "[calibration] an activation before layer ", layer,
            " is not finite: the weights do not fit this network");
    }
  return result;
}

}  // namespace svnet
