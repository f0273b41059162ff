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
/// one vector past its end. k is at most kPackedDepth, or a.run divides that.
void packed_multiply(Index rows, const PanelRows& a, const PackedWeights& weights, Index first, Index last,
                     const PackedFinish& finish, float* c);

/// The whole product of plain rows a (rows, k), in parallel.
void packed_gemm(Parallel& parallel, Index rows, const float* a, const PackedWeights& weights,
                 const PackedFinish& finish, float* c);

/// Rows that one task multiplies when each costs k products a column: few enough to stay in L2 beside a panel, and even
/// among tasks.
Index packed_block_rows(Index rows, Index k);

}  // namespace svnet::kernels
