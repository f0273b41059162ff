#pragma once
#include "base/parallel.h"
#include "nn/kernels/window.h"

namespace svnet::kernels {

/// x (N, H, W, C) with window.c = C, w (KH, KW, C, K), y (N, OH, OW, K).
struct Conv2dShape {
  Window window;
  Index k;
};

/// y = x * w, computed as the matrix of windows times w. A tile of windows is gathered at a time; 1×1 windows of stride
/// 1 are read in place.
template <class T>
void conv2d(Parallel&, const Conv2dShape&, const T* x, const T* w, T* y);
/// dx from dy (N, OH, OW, K).
template <class T>
void conv2d_input_gradient(Parallel&, const Conv2dShape&, const T* dy, const T* w, T* dx);
/// dw from x and dy. A task computes one window position (kh, kw).
template <class T>
void conv2d_weight_gradient(Parallel&, const Conv2dShape&, const T* x, const T* dy, T* dw);

/// The same three as plain loops over the definition: the test oracle.
template <class T>
void conv2d_reference(const Conv2dShape&, const T* x, const T* w, T* y);
template <class T>
void conv2d_input_gradient_reference(const Conv2dShape&, const T* dy, const T* w, T* dx);
template <class T>
void conv2d_weight_gradient_reference(const Conv2dShape&, const T* x, const T* dy, T* dw);

}  // namespace svnet::kernels
