#pragma once
#include <span>

#include "base/parallel.h"
#include "nn/kernels/packed/packed_weights.h"

namespace svnet::kernels {

/// Copies rows of `from` (depth, n) in f32 to the first rows of `to`, a matrix (to.depth, n) in f32.
/// Requires rows in [0, from.depth), no more than to.depth of them.
void copy_rows(Parallel& parallel, const PackedWeights& from, std::span<const Index> rows, PackedWeights& to);

}  // namespace svnet::kernels
