#include "nn/ops/conv2d.h"

#include "nn/autograd.h"
#include "nn/kernels/conv2d/conv2d.h"
#include "nn/kernels/depthwise/depthwise.h"
#include "nn/ops/checks.h"

namespace svnet::ops {
namespace {

Window window(const char* op, const Tensor& x, const Tensor& w, const ConvOptions& o) {
  check_operands(op, {x, w});
  check(x.rank() == 4 && w.rank() == 4, "[", op, "] expects images NxHxWxC and a weight of rank 4, got ", shapes(x, w));
  check(x.dim(3) == w.dim(2), "[", op, "] input has ", x.dim(3), " channels, weight expects ", w.dim(2), " (",
        shapes(x, w), ")");
  return window_over(
      op, x.dim(0), x.dim(1), x.dim(2), x.dim(3),
      {.kh = w.dim(0), .kw = w.dim(1), .stride_h = o.stride_h, .stride_w = o.stride_w, .padding = o.padding});
}

template <class T>
kernels::Epilogue<T> kernel_epilogue(const ConvEpilogue& epilogue) {
  return {epilogue.bias.defined() ? epilogue.bias.data<T>() : nullptr, epilogue.clamp};
}

void check_bias(const char* op, const ConvEpilogue& epilogue, Index channels) {
  check(!epilogue.bias.defined() || epilogue.bias.shape() == Shape{channels}, "[", op, "] output has ", channels,
        " channels, bias has ", epilogue.bias.defined() ? to_string(epilogue.bias.shape()) : "");
}

}  // namespace

Tensor conv2d_inference(const Tensor& x, const Tensor& w, const ConvOptions& options, const ConvEpilogue& epilogue) {
  const kernels::Conv2dShape s{.window = window("conv2d", x, w, options), .k = w.dim(3)};
  check_bias("conv2d", epilogue, s.k);
  Tensor y = Tensor::empty({s.window.n, s.window.oh, s.window.ow, s.k}, x.dtype());
  with_dtype(x.dtype(), [&]<class T>() {
    kernels::conv2d(pool(), s, x.data<T>(), w.data<T>(), y.data<T>(), kernel_epilogue<T>(epilogue));
  });
  return y;
}

Tensor depthwise_conv2d_inference(const Tensor& x, const Tensor& w, const ConvOptions& options,
                                  const ConvEpilogue& epilogue) {
  const kernels::DepthwiseShape s{.window = window("depthwise_conv2d", x, w, options), .multiplier = w.dim(3)};
  check_bias("depthwise_conv2d", epilogue, s.window.c * s.multiplier);
  Tensor y = Tensor::empty({s.window.n, s.window.oh, s.window.ow, s.window.c * s.multiplier}, x.dtype());
  with_dtype(x.dtype(), [&]<class T>() {
    kernels::depthwise(pool(), s, x.data<T>(), w.data<T>(), y.data<T>(), kernel_epilogue<T>(epilogue));
  });
  return y;
}

Tensor conv2d(const Tensor& x, const Tensor& w, const ConvOptions& options) {
  const kernels::Conv2dShape s{.window = window("conv2d", x, w, options), .k = w.dim(3)};
  Tensor y = conv2d_inference(x, w, options, {});
  return autograd::record(y, {x, w}, [s, x = x.detached(), w = w.detached()](const Tensor& dy, autograd::Gradients& g) {
    with_dtype(dy.dtype(), [&]<class T>() {
      if (g.wants(0)) {
        Tensor dx = Tensor::empty(x.shape(), x.dtype());
        kernels::conv2d_input_gradient(pool(), s, dy.data<T>(), w.data<T>(), dx.data<T>());
        g.add(0, dx);
      }
      if (g.wants(1)) {
        Tensor dw = Tensor::empty(w.shape(), w.dtype());
        kernels::conv2d_weight_gradient(pool(), s, x.data<T>(), dy.data<T>(), dw.data<T>());
        g.add(1, dw);
      }
    });
  });
}

Tensor depthwise_conv2d(const Tensor& x, const Tensor& w, const ConvOptions& options) {
  const kernels::DepthwiseShape s{.window = window("depthwise_conv2d", x, w, options), .multiplier = w.dim(3)};
  Tensor y = depthwise_conv2d_inference(x, w, options, {});
  return autograd::record(y, {x, w}, [s, x = x.detached(), w = w.detached()](const Tensor& dy, autograd::Gradients& g) {
    with_dtype(dy.dtype(), [&]<class T>() {
      if (g.wants(0)) {
        Tensor dx = Tensor::empty(x.shape(), x.dtype());
        kernels::depthwise_input_gradient(pool(), s, dy.data<T>(), w.data<T>(), dx.data<T>());
        g.add(0, dx);
      }
      if (g.wants(1)) {
        Tensor dw = Tensor::empty(w.shape(), w.dtype());
        kernels::depthwise_weight_gradient(pool(), s, x.data<T>(), dy.data<T>(), dw.data<T>());
        g.add(1, dw);
      }
    });
  });
}

Tensor separable_conv2d(const Tensor& x, const Tensor& depthwise, const Tensor& pointwise, const ConvOptions& options) {
  return conv2d(depthwise_conv2d(x, depthwise, options), pointwise, {});
}

}  // namespace svnet::ops
