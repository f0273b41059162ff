#pragma once
#include "base/aligned.h"
#include "nn/kernels/packed/panel.h"

namespace svnet::kernels {

/// A weight matrix (k, n) and a bias (n) as the packed kernels read them: panels [n / 16][k][16], the bias filled up
/// with zeros likewise. Immutable once made.
struct PackedWeights {
  Index k = 0, n = 0;
  AlignedFloats panels{}, bias{};

  const float* panel(Index i) const { return panels.get() + i * k * kPanel; }
};

/// From row-major w; bias may be nullptr, which means zeros.
PackedWeights packed_weights(Index k, Index n, const float* w, const float* bias);

}  // namespace svnet::kernels
