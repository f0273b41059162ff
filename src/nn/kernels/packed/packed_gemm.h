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

/// Products summed before the sums go to memory: longer runs would push a panel out of L2.
inline constexpr Index kPackedDepth = 2048;

/// c (rows, n) = finish(a · weights + bias) for the panels [first, last), on the calling thread. c points at row 0,
/// column 0, rows are n apart. A row's result does not depend on the rows beside it. The residual must allow reading
/// one vector past its end. k is at most kPackedDepth, or a.run divides that. scratch holds packed_scratch numbers.
void packed_multiply(Index rows, const PanelRows& a, const PackedWeights& weights, Index first, Index last,
                     const PackedFinish& finish, float* c, float* scratch = nullptr);
/// 0 for weights in f32.
Index packed_scratch(Index rows, Index k, Precision precision);

/// The whole product of plain rows a (rows, k), in parallel. scratch holds packed_gemm_scratch numbers.
void packed_gemm(Parallel& parallel, Index rows, const float* a, const PackedWeights& weights,
                 const PackedFinish& finish, float* c, float* scratch = nullptr);
Index packed_gemm_scratch(Index rows, Index k, Precision precision, int threads);

/// Rows that one task multiplies when each costs k products a column: few enough to stay in L2 beside a panel, and even
/// among tasks.
Index packed_block_rows(Index rows, Index k);
/// As many as it ever gives.
Index packed_most_rows(Index k);

/// How far apart the rows of such a block lie that has its own memory: whole vectors, but not whole pages, which would
/// all share a few lines of the cache.
inline Index packed_row_stride(Index numbers) {
  const Index whole = panels(numbers) * kPanel;
  return whole % 512 == 0 ? whole + kPanel : whole;
}

}  // namespace svnet::kernels
