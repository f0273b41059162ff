#include "nn/kernels/packed/packed_gemm.h"

#include <algorithm>

#include "nn/kernels/packed/bf16_tile.h"
#include "nn/kernels/packed/tile_kernels.h"

namespace svnet::kernels {
namespace {

/// `count` panels of weights from panel p on. n may end within the last one.
void multiply_together(const TileKernels& kernels, Index count, Index rows, const PanelRows& a,
                       const PackedWeights& weights, Index p, const PackedFinish& finish, float* c) {
  const Index n = weights.n;
  const auto [low, high] = range_of(finish.clamp);
  const TileFinish tile_finish{weights.bias.get() + p * kPanel,
                               finish.residual == nullptr ? nullptr : finish.residual + p * kPanel, n, low, high};
  for (Index begin = 0; begin < weights.panel_rows; begin += kPackedDepth) {
    const Index run = std::min(kPackedDepth, weights.panel_rows - begin);
    PanelRows part = a;
    part.data += begin / a.run * a.block_stride;
    multiply_panels(kernels, count, rows, part, run, weights.panel(p) + begin * kPanel, weights.panel_rows * kPanel,
                    {.c = c + p * kPanel,
                     .stride = n,
                     .accumulate = begin > 0,
                     .finish = begin + run == weights.panel_rows ? &tile_finish : nullptr,
                     .columns = n - p * kPanel},
                    Prefetch::following_panels);
  }
}

}  // namespace

void packed_multiply(Index rows, const PanelRows& a, const PackedWeights& weights, Index first, Index last,
                     const PackedFinish& finish, float* c, float* scratch) {
  PanelRows left = a;
  if (weights.precision == Precision::bf16) {
    left = {scratch, packed_row_stride(weights.panel_rows), kPanel};
    round_to_pairs(rows, a, weights.depth, scratch, left.row_stride);
  }
  const TileKernels kernels = weights.precision == Precision::bf16 ? bf16_tiles() : f32_tiles();
  Index p = first;
  for (; p + kernels.panels <= last; p += kernels.panels)
    multiply_together(kernels, kernels.panels, rows, left, weights, p, finish, c);
  for (; p < last; ++p) multiply_together(kernels, 1, rows, left, weights, p, finish, c);
}

Index packed_scratch(Index rows, Index depth, Precision precision) {
  return precision == Precision::bf16 ? rows * packed_row_stride(pairs(depth)) : 0;
}

Index packed_most_rows(Index depth) { return std::clamp<Index>(144 * 1024 / std::max<Index>(depth, 1), 24, 192); }

Index packed_block_rows(Index rows, Index depth) {
  const Index most = packed_most_rows(depth);
  // A multiple of four blocks, so that two or four threads finish at the same time.
  const Index least = (rows + most - 1) / most, whole = (least + 1) / 2 * 2;
  const Index blocks = rows >= 12 * whole ? whole : std::max(least, rows / 12);
  return (rows + std::max<Index>(blocks, 1) - 1) / std::max<Index>(blocks, 1);
}

void packed_gemm(Parallel& parallel, Index rows, const float* a, const PackedWeights& weights,
                 const PackedFinish& finish, float* c, float* scratch) {
  if (rows == 0) return;
  const Index block = packed_block_rows(rows, weights.depth), blocks = (rows + block - 1) / block;
  const Index all = panels(weights.n), wanted = std::clamp<Index>(16 / blocks, 1, all);
  const Index group = (all + wanted - 1) / wanted, groups = (all + group - 1) / group;
  const Index per_worker = packed_scratch(block, weights.depth, weights.precision);
  parallel.for_chunks(blocks * groups, 1, [&](Index task, Index, int worker) {
    const Index row = task / groups * block, first = task % groups * group;
    PackedFinish here = finish;
    if (here.residual != nullptr) here.residual += row * weights.n;
    packed_multiply(std::min(block, rows - row), {a + row * weights.depth, weights.depth, kPanel}, weights, first,
                    std::min(first + group, all), here, c + row * weights.n, scratch + worker * per_worker);
  });
}

Index packed_gemm_scratch(Index rows, Index depth, Precision precision, int threads) {
  return threads * packed_scratch(packed_block_rows(rows, depth), depth, precision);
}

}  // namespace svnet::kernels
