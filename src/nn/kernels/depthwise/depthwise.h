#pragma once
#include <algorithm>
#include <vector>

#include "base/parallel.h"
#include "nn/kernels/epilogue.h"
#include "nn/kernels/window.h"

namespace svnet::kernels {

/// x (N, H, W, C), w (KH, KW, C, M), y (N, OH, OW, C·M) with channel c·M + m from input channel c: Keras' depthwise
/// convolution with depth multiplier M.
struct DepthwiseShape {
  Window window;
  Index multiplier;
};

template <class T>
void depthwise_reference(Parallel&, const DepthwiseShape&, const T* x, const T* w, T* y,
                         const Epilogue<T>& epilogue = {});
/// Vectorised over channels if the multiplier is 1; otherwise the reference.
void depthwise(Parallel&, const DepthwiseShape&, const float* x, const float* w, float* y,
               const Epilogue<float>& epilogue = {});
inline void depthwise(Parallel& parallel, const DepthwiseShape& shape, const double* x, const double* w, double* y,
                      const Epilogue<double>& epilogue = {}) {
  depthwise_reference(parallel, shape, x, w, y, epilogue);
}

template <class T>
void depthwise_input_gradient_reference(Parallel&, const DepthwiseShape&, const T* dy, const T* w, T* dx);
/// Vectorised if the multiplier and the strides are 1.
void depthwise_input_gradient(Parallel&, const DepthwiseShape&, const float* dy, const float* w, float* dx);
inline void depthwise_input_gradient(Parallel& parallel, const DepthwiseShape& shape, const double* dy, const double* w,
                                     double* dx) {
  depthwise_input_gradient_reference(parallel, shape, dy, w, dx);
}

template <class T>
void depthwise_weight_gradient_reference(Parallel&, const DepthwiseShape&, const T* x, const T* dy, T* dw);
/// Vectorised if the multiplier is 1.
void depthwise_weight_gradient(Parallel&, const DepthwiseShape&, const float* x, const float* dy, float* dw);
inline void depthwise_weight_gradient(Parallel& parallel, const DepthwiseShape& shape, const double* x,
                                      const double* dy, double* dw) {
  depthwise_weight_gradient_reference(parallel, shape, x, dy, dw);
}

/// dw (KH, KW, C, M) = the sum over all output rows n · OH + oh. add_row(row, sum) adds one row's part to sum
/// (KH, KW, C, M). Partial sums over fixed runs of rows are added in order.
template <class T, class AddRow>
void sum_over_rows(Parallel& parallel, const DepthwiseShape& s, T* dw, const AddRow& add_row) {
  const Index size = s.window.kh * s.window.kw * s.window.c * s.multiplier, rows = s.window.n * s.window.oh;
  const Index run = std::max<Index>(8, (rows + 63) / 64), runs = (rows + run - 1) / run;
  std::vector<T> partial(static_cast<std::size_t>(runs * size), T{0});
  parallel.for_chunks(rows, run, [&](Index begin, Index end, int) {
    for (Index row = begin; row < end; ++row) add_row(row, partial.data() + begin / run * size);
  });
  std::fill_n(dw, size, T{0});
  for (Index r = 0; r < runs; ++r)
    for (Index i = 0; i < size; ++i) dw[i] += partial[static_cast<std::size_t>(r * size + i)];
}

}  // namespace svnet::kernels
