#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/index.h"

namespace svnet::kernels {

/// Weights rounded to whole numbers in [-127, 127], with a scale per output channel: w ≈ value · scale.
struct Int8Weights {
  std::vector<std::int8_t> values;
  std::vector<float> scales;
};

/// How weights lie around their output channels: element (o, c, i) is w[(o · channels + c) · inner + i]. A matrix
/// (depth, n) has outer = depth and channels = n.
struct ChannelShape {
  Index outer, channels, inner = 1;

  Index size() const { return outer * channels * inner; }
};

/// The scale of a channel is its largest absolute value / 127; a channel of zeros has scale 1. Halves round to even.
/// Weights that are such products already keep their values and, up to rounding, their scales. Requires finite weights.
Int8Weights int8_weights(const ChannelShape& shape, const float* w);

/// w = value · scale.
void from_int8(const ChannelShape& shape, std::span<const std::int8_t> values, std::span<const float> scales, float* w);

}  // namespace svnet::kernels
