#include "nn/kernels/packed/packed_weights.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/bf16.h"
#include "base/error.h"
#include "nn/kernels/packed/bf16_tile.h"
#include "nn/kernels/packed/int8_tile.h"

namespace svnet::kernels {

PackedWeights packed_weights(Index depth, Index n, const float* w, const float* bias, Precision precision) {
  const bool paired = precision == Precision::bf16;
  const Index padded = panels(n) * kPanel, rows = paired ? pairs(depth) : depth;
  PackedWeights packed{.depth = depth,
                       .n = n,
                       .precision = precision,
                       .panel_rows = rows,
                       .panels = aligned_floats(padded * rows),
                       .bias = aligned_floats(padded)};
  std::fill_n(packed.bias.get(), padded, 0.0f);
  if (bias != nullptr) std::copy_n(bias, n, packed.bias.get());
  for (Index p = 0; p < panels(n); ++p) {
    const Index columns = std::min(kPanel, n - p * kPanel);
    for (Index i = 0; i < rows; ++i) {
      float* to = packed.panels.get() + (p * rows + i) * kPanel;
      const float* from = w + (paired ? 2 * i : i) * n + p * kPanel;
      if (paired)
        for (Index j = 0; j < columns; ++j) {
          const std::uint32_t first = bf16_bits(from[j]), second = 2 * i + 1 < depth ? bf16_bits(from[n + j]) : 0;
          to[j] = std::bit_cast<float>(second << 16 | first);
        }
      else
        std::copy_n(from, columns, to);
      std::fill_n(to + columns, kPanel - columns, 0.0f);
    }
  }
  return packed;
}

PackedWeights packed_int8_weights(Index depth, Index n, const float* w, const float* bias,
                                  const ChannelRanges& ranges) {
  check(depth <= kMostByteDepth, "[precision] int8 takes sums of at most ", kMostByteDepth, " products, not ", depth);
  const Index padded = panels(n) * kPanel, rows = quads(depth), channels = static_cast<Index>(ranges.low.size());
  PackedWeights packed{.depth = depth,
                       .n = n,
                       .precision = Precision::int8,
                       .panel_rows = rows,
                       .panels = aligned_floats(padded * rows),
                       .bias = aligned_floats(padded),
                       .input = byte_input(depth, ranges),
                       .start = std::vector<std::int32_t>(static_cast<std::size_t>(padded)),
                       .scale = aligned_floats(padded)};
  std::fill_n(packed.panels.get(), padded * rows, 0.0f);
  std::fill_n(packed.bias.get(), padded, 0.0f);
  std::fill_n(packed.scale.get(), padded, 0.0f);
  auto* bytes = reinterpret_cast<std::int8_t*>(packed.panels.get());
  const float *factor = packed.input.factor.get(), *zero = packed.input.zero.get();
  // The weight of a byte; 0 if the input is.
  const auto weight = [&](Index i, Index column) { return factor[i] > 0 ? w[i * n + column] / double{factor[i]} : 0; };
  for (Index column = 0; column < n; ++column) {
    double largest = 0;
    for (Index i = 0; i < depth; ++i) {
      check(std::isfinite(w[i * n + column]), "[precision] int8: a weight is not finite");
      largest = std::max(largest, std::abs(weight(i, column)));
    }
    const float scale = static_cast<float>(largest / kLargestByteWeight);
    std::int64_t start = 0;
    double drift = 0;
    for (Index i = 0; scale > 0 && i < depth; ++i) {
      const double exact = weight(i, column) / scale;
      const auto rounded =
          static_cast<std::int8_t>(std::clamp<double>(std::nearbyint(exact), -kLargestByteWeight, kLargestByteWeight));
      bytes[((column / kPanel * rows + i / 4) * kPanel + column % kPanel) * 4 + i % 4] = rounded;
      start -= rounded * static_cast<std::int64_t>(zero[i]);
      drift += (rounded - exact) * double{ranges.mean[static_cast<std::size_t>(i % channels)]} * double{factor[i]};
    }
    packed.start[static_cast<std::size_t>(column)] = static_cast<std::int32_t>(start);
    packed.scale.get()[column] = scale;
    packed.bias.get()[column] =
        static_cast<float>((bias != nullptr ? bias[column] : 0.0f) - drift * static_cast<double>(scale));
  }
  return packed;
}

}  // namespace svnet::kernels
