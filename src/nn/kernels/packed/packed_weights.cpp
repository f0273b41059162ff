#include "nn/kernels/packed/packed_weights.h"

#include <algorithm>

namespace svnet::kernels {

PackedWeights packed_weights(Index k, Index n, const float* w, const float* bias) {
  const Index padded = panels(n) * kPanel;
  PackedWeights packed{.k = k, .n = n, .panels = aligned_floats(padded * k), .bias = aligned_floats(padded)};
  std::fill_n(packed.bias.get(), padded, 0.0f);
  if (bias != nullptr) std::copy_n(bias, n, packed.bias.get());
  for (Index p = 0; p < panels(n); ++p) {
    const Index columns = std::min(kPanel, n - p * kPanel);
    for (Index i = 0; i < k; ++i) {
      float* to = packed.panels.get() + (p * k + i) * kPanel;
      std::copy_n(w + i * n + p * kPanel, columns, to);
      std::fill_n(to + columns, kPanel - columns, 0.0f);
    }
  }
  return packed;
}

}  // namespace svnet::kernels
