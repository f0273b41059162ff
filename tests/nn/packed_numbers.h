#pragma once
// Helpers of tests of packed kernels: values, uninitialised memory, and the distance of a result from plain sums.
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/aligned.h"
#include "nn/kernels/epilogue.h"
#include "nn/kernels/window.h"
#include "nn/numbers.h"

namespace svnet::test {

using kernels::Clamp;

inline AlignedFloats scratch_memory(Index count) {
  AlignedFloats memory = aligned_floats(count);
  std::fill_n(memory.get(), count, NAN);  // reads of uninitialised memory show up
  return memory;
}

inline Window window(Index n, Index h, Index w, Index c, Index kernel, Index stride, const Padding& padding) {
  return window_over("test", n, h, w, c,
                     {.kh = kernel, .kw = kernel, .stride_h = stride, .stride_w = stride, .padding = padding});
}

/// Values with a vector of padding, as kernels expect.
struct Numbers {
  Numbers(std::uint32_t seed, Index size) : count(size), memory(aligned_floats(size)) {
    const Tensor drawn = random_tensor({size}, seed, DType::f32);
    std::copy_n(drawn.data<float>(), size, memory.get());
  }
  const float* get() const { return memory.get(); }
  Index count;
  AlignedFloats memory;
};

inline double clamped(double y, Clamp clamp) {
  if (clamp != Clamp::none) y = std::max(y, 0.0);
  return clamp == Clamp::relu6 ? std::min(y, 6.0) : y;
}

/// Relative L2 distance of `actual` from clamp(expected + bias + residual).
inline double distance(const float* actual, std::vector<double> expected, Index n, const float* bias,
                       const float* residual, Clamp clamp) {
  double difference = 0, norm = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    double y = expected[i] + bias[static_cast<Index>(i) % n] + (residual != nullptr ? residual[i] : 0.0f);
    y = clamped(y, clamp);
    difference += (actual[i] - y) * (actual[i] - y);
    norm += y * y;
  }
  return difference == 0 ? 0 : std::sqrt(difference / norm);  // all clamped values may be 0
}

inline std::vector<double> wide(const float* x, Index count) { return {x, x + count}; }

}  // namespace svnet::test
