#pragma once
#include <memory>
#include <span>

#include "base/aligned.h"
#include "base/parallel.h"
#include "nn/kernels/packed/packed_gemm.h"

namespace svnet::kernels {

/// A weight matrix (depth, n) rounded to int8 (int8_weights.h), and a bias (n), in panels [n / 16][depth][16] that are
/// filled up with zeros. It takes a quarter of the memory of f32, which is what a product with few rows waits for.
/// Immutable after packed_int8.
struct PackedInt8 {
  Index depth = 0, n = 0;
  std::unique_ptr<std::int8_t[], FreeAligned> panels{};
  AlignedFloats scales{}, bias{};  // (n), up to whole panels
};

/// w is row-major, finite. bias may be nullptr, which means zeros.
PackedInt8 packed_int8(Index depth, Index n, const float* w, const float* bias);

/// c (rows, n) = finish(a (rows, depth) · weights + bias) in f32. Weights become f32 a few panels at a time, in cache:
/// the result has the bits of packed_gemm with the rounded weights. Does not depend on the number of threads, and a
/// row's result not on the other rows. The residual may be read one vector past its end. scratch holds
/// int8_gemm_scratch floats.
void int8_gemm(Parallel& parallel, Index rows, const float* a, const PackedInt8& weights, const PackedFinish& finish,
               float* c, float* scratch);
Index int8_gemm_scratch(int threads);

/// As for PackedWeights (packed/copy_rows.h).
void copy_rows(Parallel& parallel, const PackedInt8& from, std::span<const Index> rows, PackedWeights& to);

}  // namespace svnet::kernels
