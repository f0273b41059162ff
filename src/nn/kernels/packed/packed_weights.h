#pragma once
#include "base/aligned.h"
#include "nn/kernels/packed/panel.h"
#include "nn/kernels/precision.h"

namespace svnet::kernels {

/// A weight matrix (k, n) and a bias (n) as the packed kernels read them: panels [n / 16][k][16], the bias filled up
/// with zeros likewise. In bf16 a panel is [⌈k / 2⌉][16] pairs (bf16_tile.h). Immutable once made.
struct PackedWeights {
  Index k = 0, n = 0;
  Precision precision = Precision::f32;
  Index depth = 0;  ///< rows of a panel
  AlignedFloats panels{}, bias{};

  const float* panel(Index i) const { return panels.get() + i * depth * kPanel; }
};

/// From row-major w; bias may be nullptr, which means zeros.
PackedWeights packed_weights(Index k, Index n, const float* w, const float* bias, Precision precision = Precision::f32);

}  // namespace svnet::kernels
