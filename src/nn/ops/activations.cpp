#include "nn/ops/activations.h"

#include "nn/autograd.h"
#include "nn/kernels/activation/activation.h"
#include "nn/ops/checks.h"

namespace svnet::ops {
namespace {

constexpr Index kChunk = 1 << 15;

/// y = forward(x) elementwise; dx = dy · slope(y), so that only the output is kept for the backward.
template <class Forward, class Slope>
Tensor elementwise(const char* op, const Tensor& x, Forward forward, Slope slope) {
  check_operands(op, {x});
  Tensor y = Tensor::empty(x.shape(), x.dtype());
  with_dtype(x.dtype(), [&]<class T>() {
    const T* from = x.data<T>();
    T* to = y.data<T>();
    pool().for_chunks(x.size(), kChunk, [&](Index begin, Index end, int) {
      for (Index i = begin; i < end; ++i) to[i] = forward(from[i]);
    });
  });
  return autograd::record(y, {x}, [y, slope](const Tensor& dy, autograd::Gradients& g) {
    Tensor dx = Tensor::empty(y.shape(), y.dtype());
    with_dtype(y.dtype(), [&]<class T>() {
      const T *value = y.data<T>(), *from = dy.data<T>();
      T* to = dx.data<T>();
      pool().for_chunks(y.size(), kChunk, [&](Index begin, Index end, int) {
        for (Index i = begin; i < end; ++i) to[i] = from[i] * slope(value[i]);
      });
    });
    g.add(0, dx);
  });
}

}  // namespace

// The comparisons are written so that NaN stays NaN.
Tensor relu(const Tensor& x) {
  return elementwise(
      "relu", x, []<class T>(T v) { return v < T{0} ? T{0} : v; }, []<class T>(T y) { return y > T{0} ? T{1} : T{0}; });
}

Tensor relu6(const Tensor& x) {
  return elementwise(
      "relu6", x, []<class T>(T v) { return v < T{0}   ? T{0}
                                            : v > T{6} ? T{6}
                                                       : v; },
      []<class T>(T y) { return y > T{0} && y < T{6} ? T{1} : T{0}; });
}

Tensor sigmoid(const Tensor& x) {
  return elementwise(
      "sigmoid", x, []<class T>(T v) { return kernels::sigmoid(v); }, []<class T>(T y) { return y * (T{1} - y); });
}

Tensor softmax(const Tensor& x) {
  const Index rows = leading("softmax", x), classes = x.dim(-1);
  Tensor y = Tensor::empty(x.shape(), x.dtype());
  with_dtype(x.dtype(), [&]<class T>() {
    pool().for_chunks(rows, 16, [&](Index begin, Index end, int) {
      for (Index row = begin; row < end; ++row)
        kernels::softmax_row(classes, x.data<T>() + row * classes, y.data<T>() + row * classes);
    });
  });
  return autograd::record(y, {x}, [=](const Tensor& dy, autograd::Gradients& g) {
    Tensor dx = Tensor::empty(y.shape(), y.dtype());
    with_dtype(y.dtype(), [&]<class T>() {
      pool().for_chunks(rows, 16, [&](Index begin, Index end, int) {
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

}  // namespace svnet::ops
