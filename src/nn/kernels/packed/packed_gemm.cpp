#include "nn/kernels/packed/packed_gemm.h"

#include <algorithm>

#include "nn/kernels/packed/bf16_tile.h"
#include "nn/kernels/packed/int8_tile.h"
#include "nn/kernels/packed/tile_kernels.h"

namespace svnet::kernels {
namespace {

TileKernels tiles_of(Precision precision) {
  switch (precision) {
    case Precision::f32:
      break;
    case Precision::bf16:
      return bf16_tiles();
    case Precision::int8:
      return int8_tiles();
  }
  return f32_tiles();
}

/// Products that are summed before the sums go to memory. Tiles of bytes sum all at once; a quad is four products.
Index depth_together(const PackedWeights& weights) {
  return weights.precision == Precision::int8 ? weights.panel_rows : kPackedDepth;
}

/// `count` panels of weights from panel p on. n may end within the last one.
void multiply_together(const TileKernels& kernels, Index count, Index rows, const PanelRows& a,
                       const PackedWeights& weights, Index p, const PackedFinish& finish, float* c) {
  const Index n = weights.n, together = depth_together(weights);
  const bool is_int8 = weights.precision == Precision::int8;
  const auto [low, high] = range_of(finish.clamp);
  const TileFinish tile_finish{.bias = weights.bias.get() + p * kPanel,
                               .residual = finish.residual == nullptr ? nullptr : finish.residual + p * kPanel,
                               .residual_stride = n,
                               .low = low,
                               .high = high,
                               .start = is_int8 ? weights.start.data() + p * kPanel : nullptr,
                               .scale = is_int8 ? weights.scale.get() + p * kPanel : nullptr};
  for (Index begin = 0; begin < weights.panel_rows; begin += together) {
    const Index run = std::min(together, weights.panel_rows - begin);
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
  const PanelRows rounded{scratch, packed_row_stride(weights.panel_rows), kPanel};
  switch (weights.precision) {
    case Precision::f32:
      return packed_multiply_rounded(rows, a, weights, first, last, finish, c);
    case Precision::bf16:
      round_to_pairs(rows, a, weights.depth, scratch, rounded.row_stride);
      break;
    case Precision::int8:
      round_to_quads(rows, a, weights.depth, weights.input, scratch, rounded.row_stride);
      break;
  }
  packed_multiply_rounded(rows, rounded, weights, first, last, finish, c);
}

void packed_multiply_rounded(Index rows, const PanelRows& a, const PackedWeights& weights, Index first, Index last,
                             const PackedFinish& finish, float* c) {
  const TileKernels kernels = tiles_of(weights.precision);
  Index p = first;
  for (; p + kernels.panels <= last; p += kernels.panels)
    multiply_together(kernels, kernels.panels, rows, a, weights, p, finish, c);
  for (; p < last; ++p) multiply_together(kernels, 1, rows, a, weights, p, finish, c);
}

Index packed_scratch(Index rows, Index depth, Precision precision) {
  switch (precision) {
    case Precision::f32:
      break;
    case Precision::bf16:
      return rows * packed_row_stride(pairs(depth));
    case Precision::int8:
      return rows * packed_row_stride(quads(depth));
  }
  return 0;
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
