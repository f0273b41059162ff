#include "nn/ops/activations.h"

#include "nn/autograd.h"
#include "nn/kernels/activation/activation.h"
#include "nn/ops/checks.h"

namespace svnet::ops {
namespace {

using kernels::Softmax;

constexpr Index kChunk = 1 << 15;

/// to[i] = body(i) for every element of `to`.
template <class T, class Body>
void fill(Tensor& to, const Body& body) {
  T* values = to.data<T>();
  thread_pool().for_chunks(to.size(), kChunk, [&](Index begin, Index end, int) {
    for (Index i = begin; i < end; ++i) values[i] = body(i);
  });
}

template <class A>
Tensor elementwise(const Tensor& x) {
  Tensor y = Tensor::empty(x.shape(), x.dtype());
  with_dtype(x.dtype(), [&]<class T>() { fill<T>(y, [from = x.data<T>()](Index i) { return A::value(from[i]); }); });
  constexpr bool kFromOutput = requires { A::slope_at_output(0.0f); };
  // Only the tensor that the slope depends on is kept for the backward.
  const Tensor kept = kFromOutput ? y : x.detached();
  return autograd::record(y, {x}, [kept](const Tensor& dy, autograd::Gradients& g) {
    Tensor dx = Tensor::empty(kept.shape(), kept.dtype());
    with_dtype(kept.dtype(), [&]<class T>() {
      fill<T>(dx, [value = kept.data<T>(), from = dy.data<T>()](Index i) {
        if constexpr (kFromOutput)
          return from[i] * A::slope_at_output(value[i]);
        else
          return from[i] * A::slope_at_input(value[i]);
      });
    });
    g.add(0, dx);
  });
}

Tensor rowwise_softmax(const char* op, const Tensor& x) {
  const Index rows = leading(op, x), classes = x.dim(-1);
  Tensor y = Tensor::empty(x.shape(), x.dtype());
  with_dtype(x.dtype(), [&]<class T>() {
    thread_pool().for_chunks(rows, 16, [&](Index begin, Index end, int) {
      for (Index row = begin; row < end; ++row)
        Softmax::row(classes, x.data<T>() + row * classes, y.data<T>() + row * classes);
    });
  });
  return autograd::record(y, {x}, [=](const Tensor& dy, autograd::Gradients& g) {
    Tensor dx = Tensor::empty(y.shape(), y.dtype());
    with_dtype(y.dtype(), [&]<class T>() {
      thread_pool().for_chunks(rows, 16, [&](Index begin, Index end, int) {
        for (Index row = begin; row < end; ++row) {
          const T *p = y.data<T>() + row * classes, *d = dy.data<T>() + row * classes;
          T dot{0};
          for (Index c = 0; c < classes; ++c) dot += p[c] * d[c];
          for (Index c = 0; c < classes; ++c) dx.data<T>()[row * classes + c] = p[c] * (d[c] - dot);
        }
      });
    });
    g.add(0, dx);
  });
}

}  // namespace

Tensor activation(const Tensor& x, Activation activation) {
  const char* op = name_of(activation);
  check_operands(op, {x});
  return kernels::with_activation(activation, [&]<class A>(A) {
    if constexpr (std::is_same_v<A, kernels::Linear>)
      return x;
    else if constexpr (std::is_same_v<A, Softmax>)
      return rowwise_softmax(op, x);
    else
      return elementwise<A>(x);
  });
}

}  // namespace svnet::ops
