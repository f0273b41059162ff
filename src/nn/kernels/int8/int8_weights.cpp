#include "nn/kernels/int8/int8_weights.h"

#include <algorithm>
#include <cmath>

namespace svnet::kernels {
namespace {

constexpr float kLargest = 127;

/// Calls body(index of the first element, channel) for each run of `inner` elements.
template <class Body>
void for_runs(const ChannelShape& shape, const Body& body) {
  for (Index outer = 0; outer < shape.outer; ++outer)
    for (Index channel = 0; channel < shape.channels; ++channel)
      body((outer * shape.channels + channel) * shape.inner, static_cast<std::size_t>(channel));
}

}  // namespace

Int8Weights int8_weights(const ChannelShape& shape, const float* w) {
  Int8Weights result{.values = std::vector<std::int8_t>(static_cast<std::size_t>(shape.size())),
                     .scales = std::vector<float>(static_cast<std::size_t>(shape.channels))};
  for_runs(shape, [&](Index first, std::size_t channel) {
    float& largest = result.scales[channel];
    for (Index i = 0; i < shape.inner; ++i) largest = std::max(largest, std::abs(w[first + i]));
  });
  for (float& scale : result.scales) scale = scale > 0 ? scale / kLargest : 1;
  for_runs(shape, [&](Index first, std::size_t channel) {
    for (Index i = first; i < first + shape.inner; ++i) {
      // A scale that is a denormal number may be so inexact that the quotient leaves the range.
      const float value = std::clamp(std::nearbyint(w[i] / result.scales[channel]), -kLargest, kLargest);
      result.values[static_cast<std::size_t>(i)] = static_cast<std::int8_t>(value);
    }
  });
  return result;
}

void from_int8(const ChannelShape& shape, std::span<const std::int8_t> values, std::span<const float> scales,
               float* w) {
  for_runs(shape, [&](Index first, std::size_t channel) {
    for (Index i = first; i < first + shape.inner; ++i)
      w[i] = static_cast<float>(values[static_cast<std::size_t>(i)]) * scales[channel];
  });
}

}  // namespace svnet::kernels
