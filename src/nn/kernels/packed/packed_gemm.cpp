#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/kernels/packed/packed_gemm.cpp"
#include "nn/kernels/packed/packed_gemm.h"

#include <algorithm>
#include <limits>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "nn/kernels/packed/micro_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {

/// kPanels whole panels, or one whose columns end inside it: then tile by tile over a scratch tile.
template <int kPanels>
void multiply_some_panels(Index rows, const PanelRows& a, const PackedWeights& weights, Index p,
                          const PackedFinish& finish, float low, float high, float* c) {
  const Index n = weights.n, columns = HWY_MIN(kPanels * kPanel, n - p * kPanel);
  TileFinish tile_finish{weights.bias.get() + p * kPanel,
                         finish.residual == nullptr ? nullptr : finish.residual + p * kPanel, n, low, high};
  for (Index begin = 0; begin < weights.k; begin += kPackedDepth) {
    const Index run = HWY_MIN(kPackedDepth, weights.k - begin);
    const bool is_last = begin + run == weights.k;
    PanelRows part = a;
    part.data += begin / a.run * a.block_stride;
    const float* panel = weights.panel(p) + begin * kPanel;
    if (columns == kPanels * kPanel) {
      multiply_panels_together<kPanels>(rows, part, run, panel, weights.k * kPanel,
                                        {c + p * kPanel, n, begin > 0, is_last ? &tile_finish : nullptr});
      continue;
    }
    alignas(kAlignment) float tile[kTileRows * kPanel];
    for (Index row = 0; row < rows; row += kTileRows, part.data += kTileRows * part.row_stride) {
      const Index height = HWY_MIN(Index{kTileRows}, rows - row);
      float* to = c + row * n + p * kPanel;
      TileFinish here = tile_finish;
      if (here.residual != nullptr) here.residual += row * n;
      if (begin > 0)
        for (Index r = 0; r < height; ++r) std::copy_n(to + r * n, columns, tile + r * kPanel);
      multiply_panel(height, part, run, panel, {tile, kPanel, begin > 0, is_last ? &here : nullptr});
      for (Index r = 0; r < height; ++r) std::copy_n(tile + r * kPanel, columns, to + r * n);
    }
  }
}

void multiply_panels(Index rows, const PanelRows& a, const PackedWeights& weights, Index first, Index last,
                     const PackedFinish& finish, float* c) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const float low = finish.clamp == Clamp::none ? -kInfinity : 0.0f;
  const float high = finish.clamp == Clamp::relu6 ? 6.0f : kInfinity;
  Index p = first;
  if constexpr (kTilePanels > 1)
    for (const Index whole = HWY_MIN(last, weights.n / kPanel); p + kTilePanels <= whole; p += kTilePanels)
      multiply_some_panels<kTilePanels>(rows, a, weights, p, finish, low, high, c);
  for (; p < last; ++p) multiply_some_panels<1>(rows, a, weights, p, finish, low, high, c);
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::kernels {

HWY_EXPORT(multiply_panels);

void packed_multiply(Index rows, const PanelRows& a, const PackedWeights& weights, Index first, Index last,
                     const PackedFinish& finish, float* c) {
  HWY_DYNAMIC_DISPATCH(multiply_panels)(rows, a, weights, first, last, finish, c);
}

Index packed_block_rows(Index rows, Index k) {
  const Index most = std::clamp<Index>(72 * 1024 / std::max<Index>(k, 1), 24, 96);
  // Multiples of four, so that two or four threads end together.
  const Index least = (rows + most - 1) / most, whole = (least + 3) / 4 * 4;
  const Index blocks = rows >= 12 * whole ? whole : std::max(least, rows / 12);
  return (rows + std::max<Index>(blocks, 1) - 1) / std::max<Index>(blocks, 1);
}

void packed_gemm(Parallel& parallel, Index rows, const float* a, const PackedWeights& weights,
                 const PackedFinish& finish, float* c) {
  if (rows == 0) return;
  const Index block = packed_block_rows(rows, weights.k), blocks = (rows + block - 1) / block;
  const Index all = panels(weights.n), wanted = std::clamp<Index>(16 / blocks, 1, all);
  const Index group = (all + wanted - 1) / wanted, groups = (all + group - 1) / group;
  parallel.for_chunks(blocks * groups, 1, [&](Index task, Index, int) {
    const Index row = task / groups * block, first = task % groups * group;
    PackedFinish here = finish;
    if (here.residual != nullptr) here.residual += row * weights.n;
    packed_multiply(std::min(block, rows - row), {a + row * weights.k, weights.k, kPanel}, weights, first,
                    std::min(first + group, all), here, c + row * weights.n);
  });
}

}  // namespace svnet::kernels
#endif
