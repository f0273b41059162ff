#include "nn/ops/conv2d.h"

#include "nn/autograd.h"
#include "nn/kernels/conv2d/conv2d.h"
#include "nn/kernels/depthwise/depthwise.h"
#include "nn/kernels/winograd/winograd.h"
#include "nn/ops/checks.h"

namespace svnet::ops {
namespace {

Window window(const char* op, const Tensor& x, const Tensor& w, const ConvOptions& o) {
  check_operands(op, {x, w});
  check(x.rank() == 4 && w.rank() == 4 && w.size() > 0, "[", op,
        "] expects images NxHxWxC and a weight of rank 4, got ", shapes(x, w));
  check(x.dim(3) == w.dim(2), "[", op, "] input has ", x.dim(3), " channels, weight expects ", w.dim(2), " (",
        shapes(x, w), ")");
  return window_over(
      op, x.dim(0), x.dim(1), x.dim(2), x.dim(3),
      {.kh = w.dim(0), .kw = w.dim(1), .stride_h = o.stride_h, .stride_w = o.stride_w, .padding = o.padding});
}

/// Whether the three passes of a convolution use Winograd: 3×3 of stride 1 in f32.
bool uses_winograd(const kernels::Conv2dShape& s, DType dtype, kernels::Convolution convolution) {
  return dtype == DType::f32 && s.window.n > 0 && kernels::winograd_fits(s.window, s.k) &&
         convolution != kernels::Convolution::direct;
}

Tensor direct_forward(const kernels::Conv2dShape& s, const Tensor& x, const Tensor& w) {
  Tensor y = Tensor::empty({s.window.n, s.window.oh, s.window.ow, s.k}, x.dtype());
  with_dtype(x.dtype(), [&]<class T>() { kernels::conv2d(thread_pool(), s, x.data<T>(), w.data<T>(), y.data<T>()); });
  return y;
}

/// Scratch memory comes from where tensors' does, which keeps freed blocks.
Tensor scratch(Index count) { return Tensor::empty({count}); }

Tensor winograd_forward(const Window& window, const Tensor& x, const kernels::WinogradWeights& weights) {
  Tensor y = Tensor::empty({window.n, window.oh, window.ow, weights.k});
  Tensor memory = scratch(kernels::winograd_scratch(window, weights, thread_pool().threads()));
  kernels::winograd_conv2d(thread_pool(), window, x.data<float>(), weights, {}, y.data<float>(), memory.data<float>());
  return y;
}

Tensor input_gradient(const kernels::Conv2dShape& s, bool winograd, const Tensor& dy, const Tensor& w) {
  if (winograd)
    return winograd_forward(s.window.input_gradient(s.k), dy,
                            kernels::winograd_flipped_weights(s.window.c, s.k, w.data<float>()));
  Tensor dx = Tensor::empty({s.window.n, s.window.h, s.window.w, s.window.c}, dy.dtype());
  with_dtype(dy.dtype(), [&]<class T>() {
    kernels::conv2d_input_gradient(thread_pool(), s, dy.data<T>(), w.data<T>(), dx.data<T>());
  });
  return dx;
}

Tensor weight_gradient(const kernels::Conv2dShape& s, bool winograd, const Tensor& x, const Tensor& dy) {
  Tensor dw = Tensor::empty({s.window.kh, s.window.kw, s.window.c, s.k}, dy.dtype());
  if (winograd) {
    Tensor memory = scratch(kernels::winograd_weight_gradient_scratch(s.window, s.k));
    kernels::winograd_weight_gradient(thread_pool(), s.window, s.k, x.data<float>(), dy.data<float>(), dw.data<float>(),
                                      memory.data<float>());
    return dw;
  }
  with_dtype(dy.dtype(), [&]<class T>() {
    kernels::conv2d_weight_gradient(thread_pool(), s, x.data<T>(), dy.data<T>(), dw.data<T>());
  });
  return dw;
}

}  // namespace

Tensor conv2d(const Tensor& x, const Tensor& w, const ConvOptions& options) {
  const kernels::Conv2dShape s{.window = window("conv2d", x, w, options), .k = w.dim(3)};
  const bool winograd = uses_winograd(s, x.dtype(), options.convolution);
  Tensor y = winograd
                 ? winograd_forward(s.window, x, kernels::winograd_weights(s.window.c, s.k, w.data<float>(), nullptr))
                 : direct_forward(s, x, w);
  return autograd::record(y, {x, w},
                          [s, winograd, x = x.detached(), w = w.detached()](const Tensor& dy, autograd::Gradients& g) {
                            if (g.wants(0)) g.add(0, input_gradient(s, winograd, dy, w));
                            if (g.wants(1)) g.add(1, weight_gradient(s, winograd, x, dy));
                          });
}

Tensor depthwise_conv2d(const Tensor& x, const Tensor& w, const ConvOptions& options) {
  const kernels::DepthwiseShape s{.window = window("depthwise_conv2d", x, w, options), .multiplier = w.dim(3)};
  Tensor y = Tensor::empty({s.window.n, s.window.oh, s.window.ow, s.window.c * s.multiplier}, x.dtype());
  with_dtype(x.dtype(),
             [&]<class T>() { kernels::depthwise(thread_pool(), s, x.data<T>(), w.data<T>(), y.data<T>()); });
  return autograd::record(y, {x, w}, [s, x = x.detached(), w = w.detached()](const Tensor& dy, autograd::Gradients& g) {
    with_dtype(dy.dtype(), [&]<class T>() {
      if (g.wants(0)) {
        Tensor dx = Tensor::empty(x.shape(), x.dtype());
        kernels::depthwise_input_gradient(thread_pool(), s, dy.data<T>(), w.data<T>(), dx.data<T>());
        g.add(0, dx);
      }
      if (g.wants(1)) {
        Tensor dw = Tensor::empty(w.shape(), w.dtype());
        kernels::depthwise_weight_gradient(thread_pool(), s, x.data<T>(), dy.data<T>(), dw.data<T>());
        g.add(1, dw);
      }
    });
  });
}

Tensor separable_conv2d(const Tensor& x, const Tensor& depthwise, const Tensor& pointwise, const ConvOptions& options) {
  return conv2d(depthwise_conv2d(x, depthwise, options), pointwise, {});
}

}  // namespace svnet::ops
