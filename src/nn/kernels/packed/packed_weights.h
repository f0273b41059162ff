#pragma once
#include "base/aligned.h"
#include "nn/kernels/packed/byte_input.h"
#include "nn/kernels/packed/panel.h"
#include "nn/kernels/precision.h"

namespace svnet::kernels {

/// A weight matrix (depth, n) and a bias (n) in the layout of the packed kernels: panels [n / 16][panel_rows][16] and a
/// bias that is filled up with zeros to whole panels. Immutable after packed_weights.
struct PackedWeights {
  Index depth = 0, n = 0;
  Precision precision = Precision::f32;
  Index panel_rows = 0;  ///< depth in f32, ⌈depth / 2⌉ pairs in bf16 (bf16_tile.h), quads in int8 (int8_tile.h)
  AlignedFloats panels{}, bias{};
  // In int8 only: how the left operand becomes bytes; per column what a sum starts with, and what it is multiplied by.
  ByteInput input{};
  std::vector<std::int32_t> start{};
  AlignedFloats scale{};

  const float* panel(Index i) const { return panels.get() + i * panel_rows * kPanel; }
};

/// In f32 or bf16. w is row-major. bias may be nullptr, which means zeros.
PackedWeights packed_weights(Index depth, Index n, const float* w, const float* bias,
                             Precision precision = Precision::f32);

/// In int8, for a left operand within `ranges`, of depth / ranges' channels groups of channels. What an input channel's
/// bytes are multiplied by goes into its weights, which then are rounded with a scale for each column. The bias takes
/// away what this rounding adds to a column on average. Throws Error if the depth is larger than kMostByteDepth.
PackedWeights packed_int8_weights(Index depth, Index n, const float* w, const float* bias, const ChannelRanges& ranges);

}  // namespace svnet::kernels
