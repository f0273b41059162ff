#include "nn/ops/dense.h"

#include "base/communicator.h"
#include "nn/autograd.h"
#include "nn/kernels/batch_norm/batch_norm.h"
#include "nn/kernels/gemm.h"
#include "nn/kernels/packed/streamed_gemm.h"
#include "nn/ops/checks.h"

namespace svnet::ops {
namespace {
constexpr Index kFewRows = 64;

/// The tensor y (rows, columns) that multiply(parallel, y) fills in chunks that write to separate elements. With a
/// communicator each process computes a share of the chunks and receives the others.
template <class Multiply>
Tensor shared_product(Communicator* communicator, Index rows, Index columns, DType dtype, const Multiply& multiply) {
  if (communicator == nullptr || communicator->size() == 1) {
    Tensor y = Tensor::empty({rows, columns}, dtype);
    multiply(thread_pool(), y);
    return y;
  }
  Tensor y = Tensor::zeros({rows, columns}, dtype);
  Parallel share = thread_pool().share(*communicator);
  multiply(share, y);
  communicator->all_reduce({y.data<float>(), static_cast<std::size_t>(y.size())});
  return y;
}

}  // namespace

Tensor dense(const Tensor& x, const Tensor& w, Communicator* communicator) {
  check_operands("dense", {x, w});
  check(x.rank() == 2 && w.rank() == 2 && w.size() > 0, "[dense] expects rows MxC and a weight CxK, got ",
        shapes(x, w));
  check(x.dim(1) == w.dim(0), "[dense] input has ", x.dim(1), " features, weight expects ", w.dim(0), " (",
        shapes(x, w), ")");
  const Index rows = x.dim(0), features = x.dim(1), units = w.dim(1);
  const Tensor y = shared_product(communicator, rows, units, x.dtype(), [&](Parallel& parallel, Tensor& to) {
    with_dtype(x.dtype(), [&]<class T>() {
      // Few rows use each weight only a few times: the speed of reading the weights from memory decides.
      if constexpr (std::is_same_v<T, float>)
        if (rows <= kFewRows)
          return kernels::streamed_gemm(parallel, {.m = rows, .n = units, .k = features}, x.data<T>(), w.data<T>(),
                                        to.data<T>());
      kernels::gemm(parallel, {.m = rows, .n = units, .k = features}, x.data<T>(), w.data<T>(), to.data<T>());
    });
  });
  return autograd::record(y, {x, w}, [=, x = x.detached(), w = w.detached()](const Tensor& dy, autograd::Gradients& g) {
    if (g.wants(0))
      g.add(0, shared_product(communicator, rows, features, x.dtype(), [&](Parallel& parallel, Tensor& dx) {
              with_dtype(dy.dtype(), [&]<class T>() {
                kernels::gemm(parallel, {.m = rows, .n = features, .k = units, .transpose_b = true}, dy.data<T>(),
                              w.data<T>(), dx.data<T>());
              });
            }));
    if (g.wants(1)) g.add_product(1, x, dy);
  });
}

Tensor bias_add(const Tensor& x, const Tensor& bias) {
  const Index rows = leading("bias_add", x), channels = x.dim(-1);
  check_operands("bias_add", {x, bias});
  check(bias.rank() == 1 && bias.dim(0) == channels, "[bias_add] input has ", channels, " channels, bias has ",
        to_string(bias.shape()));
  Tensor y = Tensor::empty(x.shape(), x.dtype());
  with_dtype(x.dtype(), [&]<class T>() {
    const T *from = x.data<T>(), *b = bias.data<T>();
    T* to = y.data<T>();
    thread_pool().for_chunks(rows, 64, [&](Index begin, Index end, int) {
      for (Index row = begin; row < end; ++row)
        for (Index c = 0; c < channels; ++c) to[row * channels + c] = from[row * channels + c] + b[c];
    });
  });
  return autograd::record(y, {x, bias}, [=](const Tensor& dy, autograd::Gradients& g) {
    if (g.wants(1)) {
      Tensor db = Tensor::empty({channels}, dy.dtype());
      with_dtype(dy.dtype(), [&]<class T>() {
        kernels::column_sums<T>(thread_pool(), {.rows = rows, .channels = channels}, dy.data<T>(), nullptr,
                                db.data<T>());
      });
      g.add(1, db);
    }
    g.add(0, dy);
  });
}

}  // namespace svnet::ops
