#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/kernels/packed/packed_gemm.cpp"
#include "nn/kernels/packed/packed_gemm.h"

#include <algorithm>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "nn/kernels/packed/bf16_tile.h"
#include "nn/kernels/packed/micro_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {

/// kPanels panels, the last of which n may end in.
template <int kPanels>
void multiply_some_panels(Index rows, const PanelRows& a, const PackedWeights& weights, Index p,
                          const PackedFinish& finish, float low, float high, float* c) {
  const Index n = weights.n;
  const TileFinish tile_finish{weights.bias.get() + p * kPanel,
                               finish.residual == nullptr ? nullptr : finish.residual + p * kPanel, n, low, high};
  const MultiplyTile* kernels =
      weights.precision == Precision::bf16 ? bf16_tiles(kPanels) : kTileKernels<kPanels>.data();
  for (Index begin = 0; begin < weights.depth; begin += kPackedDepth) {
    const Index run = HWY_MIN(kPackedDepth, weights.depth - begin);
    PanelRows part = a;
    part.data += begin / a.run * a.block_stride;
    multiply_panels_together<kPanels>(rows, part, run, weights.panel(p) + begin * kPanel, weights.depth * kPanel,
                                      {.c = c + p * kPanel,
                                       .stride = n,
                                       .accumulate = begin > 0,
                                       .finish = begin + run == weights.depth ? &tile_finish : nullptr,
                                       .columns = n - p * kPanel},
                                      kernels, true);
  }
}

void multiply_panels(Index rows, const PanelRows& a, const PackedWeights& weights, Index first, Index last,
                     const PackedFinish& finish, float* c) {
  const auto [low, high] = range_of(finish.clamp);
  Index p = first;
  if constexpr (kTilePanels > 1)
    for (; p + kTilePanels <= last; p += kTilePanels)
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
                     const PackedFinish& finish, float* c, float* scratch) {
  PanelRows left = a;
  if (weights.precision == Precision::bf16) {
    left = {scratch, packed_row_stride(weights.depth), kPanel};
    round_to_pairs(rows, a, weights.k, scratch, left.row_stride);
  }
  HWY_DYNAMIC_DISPATCH(multiply_panels)(rows, left, weights, first, last, finish, c);
}

Index packed_scratch(Index rows, Index k, Precision precision) {
  return precision == Precision::bf16 ? rows * packed_row_stride(pairs(k)) : 0;
}

Index packed_most_rows(Index k) { return std::clamp<Index>(72 * 1024 / std::max<Index>(k, 1), 24, 96); }

Index packed_block_rows(Index rows, Index k) {
  const Index most = packed_most_rows(k);
  // Multiples of four, so that two or four threads end together.
  const Index least = (rows + most - 1) / most, whole = (least + 3) / 4 * 4;
  const Index blocks = rows >= 12 * whole ? whole : std::max(least, rows / 12);
  return (rows + std::max<Index>(blocks, 1) - 1) / std::max<Index>(blocks, 1);
}

void packed_gemm(Parallel& parallel, Index rows, const float* a, const PackedWeights& weights,
                 const PackedFinish& finish, float* c, float* scratch) {
  if (rows == 0) return;
  const Index block = packed_block_rows(rows, weights.k), blocks = (rows + block - 1) / block;
  const Index all = panels(weights.n), wanted = std::clamp<Index>(16 / blocks, 1, all);
  const Index group = (all + wanted - 1) / wanted, groups = (all + group - 1) / group;
  const Index per_worker = packed_scratch(block, weights.k, weights.precision);
  parallel.for_chunks(blocks * groups, 1, [&](Index task, Index, int worker) {
    const Index row = task / groups * block, first = task % groups * group;
    PackedFinish here = finish;
    if (here.residual != nullptr) here.residual += row * weights.n;
    packed_multiply(std::min(block, rows - row), {a + row * weights.k, weights.k, kPanel}, weights, first,
                    std::min(first + group, all), here, c + row * weights.n, scratch + worker * per_worker);
  });
}

Index packed_gemm_scratch(Index rows, Index k, Precision precision, int threads) {
  return threads * packed_scratch(packed_block_rows(rows, k), k, precision);
}

}  // namespace svnet::kernels
#endif
