#include "nn/ops/multiply.h"

#include "nn/autograd.h"
#include "nn/kernels/multiply/multiply.h"
#include "nn/ops/checks.h"

namespace svnet::ops {
namespace {

bool is_factor_per_channel(const Shape& x, const Shape& factor) {
  if (x.size() != 4) return false;
  return factor == Shape{x[0], 1, 1, x[3]} || factor == Shape{x[0], x[3]};
}

kernels::MultiplyShape shape_of(const Tensor& x, bool per_channel) {
  if (!per_channel) return {.n = 1, .positions = leading("multiply", x), .channels = x.dim(-1), .per_channel = false};
  return {.n = x.dim(0), .positions = x.dim(1) * x.dim(2), .channels = x.dim(3), .per_channel = true};
}

Tensor product(const kernels::MultiplyShape& s, const Tensor& x, const Tensor& factor) {
  Tensor y = Tensor::empty(x.shape(), x.dtype());
  with_dtype(x.dtype(),
             [&]<class T>() { kernels::multiply(thread_pool(), s, x.data<T>(), factor.data<T>(), y.data<T>()); });
  return y;
}

Tensor factor_gradient(const kernels::MultiplyShape& s, const Tensor& x, const Tensor& dy, const Shape& shape) {
  if (!s.per_channel) return product(s, dy, x);
  Tensor gradient = Tensor::empty(shape, x.dtype());
  with_dtype(x.dtype(), [&]<class T>() {
    kernels::multiply_channel_gradient(thread_pool(), s, x.data<T>(), dy.data<T>(), gradient.data<T>());
  });
  return gradient;
}

}  // namespace

Tensor multiply(const Tensor& a, const Tensor& b) {
  check_operands("multiply", {a, b});
  const bool swapped = a.shape() != b.shape() && is_factor_per_channel(b.shape(), a.shape());
  const Tensor &x = swapped ? b : a, &factor = swapped ? a : b;
  const bool per_channel = x.shape() != factor.shape();
  check(!per_channel || is_factor_per_channel(x.shape(), factor.shape()), "[multiply] expects one shape, or ",
        "NxHxWxC and Nx1x1xC or NxC, got ", shapes(a, b));
  const auto s = shape_of(x, per_channel);
  return autograd::record(product(s, x, factor), {x, factor},
                          [s, x = x.detached(), factor = factor.detached()](const Tensor& dy, autograd::Gradients& g) {
                            if (g.wants(0)) g.add(0, product(s, dy, factor));
                            if (g.wants(1)) g.add(1, factor_gradient(s, x, dy, factor.shape()));
                          });
}

}  // namespace svnet::ops
