#include "nn/kernels/packed/copy_rows.h"

#include <algorithm>
#include <bit>

namespace svnet::kernels {
namespace {

/// One row of a panel of pairs (bf16_tile.h), as f32.
void copy_row_of_pairs(const float* panel, Index row, float* to) {
  for (Index j = 0; j < kPanel; ++j) {
    const auto pair = std::bit_cast<std::uint32_t>(panel[row / 2 * kPanel + j]);
    to[j] = std::bit_cast<float>(row % 2 == 0 ? pair << 16 : pair & 0xFFFF0000u);
  }
}

}  // namespace

void copy_rows(Parallel& parallel, const PackedWeights& from, std::span<const Index> rows, PackedWeights& to) {
  parallel.for_chunks(panels(from.n), 4, [&](Index first, Index last, int) {
    for (Index p = first; p < last; ++p) {
      float* target = to.panels.get() + p * to.panel_rows * kPanel;
      for (const Index row : rows) {
        if (from.precision == Precision::bf16)
          copy_row_of_pairs(from.panel(p), row, target);
        else
          std::copy_n(from.panel(p) + row * kPanel, kPanel, target);
        target += kPanel;
      }
    }
  });
}

}  // namespace svnet::kernels
