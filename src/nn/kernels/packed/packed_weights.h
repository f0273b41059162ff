#pragma once
#include "base/aligned.h"
#include "nn/kernels/packed/panel.h"
#include "nn/kernels/precision.h"

namespace svnet::kernels {

/// A weight matrix (depth, n) and a bias (n) in the layout of the packed kernels: panels [n / 16][panel_rows][16] and a
/// bias that is filled up with zeros to whole panels. Immutable after packed_weights.
struct PackedWeights {
  Index depth = 0, n = 0;
  Precision precision = Precision::f32;
  Index panel_rows = 0;  ///< depth in f32, ⌈depth / 2⌉ pairs in bf16 (bf16_tile.h)
  AlignedFloats panels{}, bias{};

  const float* panel(Index i) const { return panels.get() + i * panel_rows * kPanel; }
};

/// w is row-major. bias may be nullptr, which means zeros.
PackedWeights packed_weights(Index depth, Index n, const float* w, const float* bias,
                             Precision precision = Precision::f32);

}  // namespace svnet::kernels
