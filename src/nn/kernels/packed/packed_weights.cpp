#include "nn/kernels/packed/packed_weights.h"

#include <algorithm>
#include <bit>

#include "nn/kernels/packed/bf16_tile.h"

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
          const std::uint32_t second = 2 * i + 1 < depth ? bf16_bits(from[n + j]) : 0;
          to[j] = std::bit_cast<float>(second << 16 | bf16_bits(from[j]));
        }
      else
        std::copy_n(from, columns, to);
      std::fill_n(to + columns, kPanel - columns, 0.0f);
    }
  }
  return packed;
}

}  // namespace svnet::kernels
