#pragma once
#include "base/parallel.h"
#include "nn/kernels/epilogue.h"
#include "nn/kernels/packed/packed_weights.h"

namespace svnet::kernels {

/// What a packed kernel does to its output (rows, n) after the bias: y = clamp(y + residual).
struct PackedFinish {
  Clamp clamp = Clamp::none;
  const float* residual = nullptr;  ///< (rows, n), or nullptr
};

/// Products that are summed before the sums go to memory: with more, a panel would not stay in L2.
inline constexpr Index kPackedDepth = 2048;

/// c (rows, n) = finish(a (rows, depth) · weights + bias) for the panels [first, last), on the calling thread. c points
/// at row 0 and column 0, and its rows are n apart. A row's result does not depend on the other rows.
/// Requires: depth is at most kPackedDepth, or a.run divides kPackedDepth; the residual may be read one vector past its
/// end; scratch holds packed_scratch floats.
void packed_multiply(Index rows, const PanelRows& a, const PackedWeights& weights, Index first, Index last,
                     const PackedFinish& finish, float* c, float* scratch = nullptr);
/// The same for rows that are as weights.precision needs them: pairs in bf16, quads in int8.
void packed_multiply_rounded(Index rows, const PanelRows& a, const PackedWeights& weights, Index first, Index last,
                             const PackedFinish& finish, float* c);
/// Returns 0 for f32.
Index packed_scratch(Index rows, Index depth, Precision precision);

/// The whole product of plain rows a (rows, depth), in parallel. scratch holds packed_gemm_scratch floats.
void packed_gemm(Parallel& parallel, Index rows, const float* a, const PackedWeights& weights,
                 const PackedFinish& finish, float* c, float* scratch = nullptr);
Index packed_gemm_scratch(Index rows, Index depth, Precision precision, int threads);

/// How many of `rows` rows one task multiplies: few enough to stay in L2 beside a panel, and about the same for each
/// task.
Index packed_block_rows(Index rows, Index depth);
/// The largest value that packed_block_rows returns for this depth.
Index packed_most_rows(Index depth);

/// The distance between rows of `count` floats in scratch memory: whole vectors, but not whole pages, because rows a
/// page apart would share a few lines of the cache.
inline Index packed_row_stride(Index count) {
  const Index whole = panels(count) * kPanel;
  return whole % 512 == 0 ? whole + kPanel : whole;
}

}  // namespace svnet::kernels
