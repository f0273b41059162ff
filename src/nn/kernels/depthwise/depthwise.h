#pragma once
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
/// Vectorised over channels where the multiplier is 1; otherwise the reference.
void depthwise(Parallel&, const DepthwiseShape&, const float* x, const float* w, float* y,
               const Epilogue<float>& epilogue = {});
inline void depthwise(Parallel& parallel, const DepthwiseShape& shape, const double* x, const double* w, double* y,
                      const Epilogue<double>& epilogue = {}) {
  depthwise_reference(parallel, shape, x, w, y, epilogue);
}

template <class T>
void depthwise_input_gradient(Parallel&, const DepthwiseShape&, const T* dy, const T* w, T* dx);
template <class T>
void depthwise_weight_gradient(Parallel&, const DepthwiseShape&, const T* x, const T* dy, T* dw);

}  // namespace svnet::kernels
