#include "nn/ops/pooling.h"

#include <vector>

#include "nn/autograd.h"
#include "nn/kernels/pool/pool.h"
#include "nn/ops/checks.h"
#include "nn/ops/shaping.h"

namespace svnet::ops {
namespace {

Window window(const char* op, const Tensor& x, const WindowOptions& options) {
  check_operands(op, {x});
  check(x.rank() == 4, "[", op, "] expects images NxHxWxC, got ", to_string(x.shape()));
  return window_over(op, x.dim(0), x.dim(1), x.dim(2), x.dim(3), options);
}

WindowOptions whole_image(const char* op, const Tensor& x) {
  check_operands(op, {x});
  check(x.rank() == 4, "[", op, "] expects images NxHxWxC, got ", to_string(x.shape()));
  return {.kh = x.dim(1), .kw = x.dim(2), .stride_h = 1, .stride_w = 1, .padding = Padding::valid()};
}

}  // namespace

Tensor max_pool2d(const Tensor& x, const WindowOptions& options) {
  const Window s = window("max_pool2d", x, options);
  Tensor y = Tensor::empty({s.n, s.oh, s.ow, s.c}, x.dtype());
  auto source = std::make_shared<std::vector<std::int64_t>>(static_cast<std::size_t>(y.size()));
  with_dtype(x.dtype(),
             [&]<class T>() { kernels::max_pool(thread_pool(), s, x.data<T>(), y.data<T>(), source->data()); });
  return autograd::record(y, {x}, [s, source](const Tensor& dy, autograd::Gradients& g) {
    Tensor dx = Tensor::empty({s.n, s.h, s.w, s.c}, dy.dtype());
    with_dtype(dy.dtype(), [&]<class T>() {
      kernels::max_pool_gradient(thread_pool(), s, dy.data<T>(), source->data(), dx.data<T>());
    });
    g.add(0, dx);
  });
}

Tensor average_pool2d(const Tensor& x, const WindowOptions& options) {
  const Window s = window("average_pool2d", x, options);
  Tensor y = Tensor::empty({s.n, s.oh, s.ow, s.c}, x.dtype());
  with_dtype(x.dtype(), [&]<class T>() { kernels::average_pool(thread_pool(), s, x.data<T>(), y.data<T>()); });
  return autograd::record(y, {x}, [s](const Tensor& dy, autograd::Gradients& g) {
    Tensor dx = Tensor::empty({s.n, s.h, s.w, s.c}, dy.dtype());
    with_dtype(dy.dtype(),
               [&]<class T>() { kernels::average_pool_gradient(thread_pool(), s, dy.data<T>(), dx.data<T>()); });
    g.add(0, dx);
  });
}

Tensor global_max_pool2d(const Tensor& x) { return flatten(max_pool2d(x, whole_image("global_max_pool2d", x))); }

Tensor global_average_pool2d(const Tensor& x) {
  return flatten(average_pool2d(x, whole_image("global_average_pool2d", x)));
}

}  // namespace svnet::ops
