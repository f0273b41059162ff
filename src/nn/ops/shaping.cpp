#include "nn/ops/shaping.h"

#include <algorithm>

#include "nn/autograd.h"
#include "nn/ops/checks.h"

namespace svnet::ops {
namespace {

/// Copies `rows` rows of `count` elements. The strides are the distances between the starts of rows.
template <class T>
void copy_rows(Index rows, Index count, const T* from, Index from_stride, T* to, Index to_stride) {
  for (Index row = 0; row < rows; ++row) std::copy_n(from + row * from_stride, count, to + row * to_stride);
}

}  // namespace

Tensor reshape(const Tensor& x, Shape shape) {
  check_operands("reshape", {x});
  return autograd::record(
      x.reshaped(std::move(shape)), {x},
      [from = x.shape()](const Tensor& dy, autograd::Gradients& g) { g.add(0, dy.reshaped(from)); });
}

Tensor flatten(const Tensor& x) {
  check_operands("flatten", {x});
  check(x.rank() >= 1, "[flatten] expects at least one axis");
  return reshape(x, {x.dim(0), element_count({x.shape().begin() + 1, x.shape().end()})});
}

Tensor zero_padding2d(const Tensor& x, const Padding& p) {
  check_operands("zero_padding2d", {x});
  check(x.rank() == 4, "[zero_padding2d] expects images NxHxWxC, got ", to_string(x.shape()));
  check(p.kind == Padding::Kind::explicit_ && std::min({p.top, p.bottom, p.left, p.right}) >= 0,
        "[zero_padding2d] needs four numbers of zeros, none negative");
  const Index n = x.dim(0), h = x.dim(1), w = x.dim(2), c = x.dim(3);
  const Index row = (w + p.left + p.right) * c, image = (h + p.top + p.bottom) * row;
  Tensor y = Tensor::zeros({n, h + p.top + p.bottom, w + p.left + p.right, c}, x.dtype());
  with_dtype(x.dtype(), [&]<class T>() {
    for (Index i = 0; i < n; ++i)
      copy_rows(h, w * c, x.data<T>() + i * h * w * c, w * c, y.data<T>() + i * image + p.top * row + p.left * c, row);
  });
  return autograd::record(y, {x}, [=](const Tensor& dy, autograd::Gradients& g) {
    Tensor dx = Tensor::empty({n, h, w, c}, dy.dtype());
    with_dtype(dy.dtype(), [&]<class T>() {
      for (Index i = 0; i < n; ++i)
        copy_rows(h, w * c, dy.data<T>() + i * image + p.top * row + p.left * c, row, dx.data<T>() + i * h * w * c,
                  w * c);
    });
    g.add(0, dx);
  });
}

Tensor add(const std::vector<Tensor>& inputs) {
  check(!inputs.empty(), "[add] needs at least one input");
  for (const Tensor& x : inputs) {
    check_operands("add", {inputs[0], x});
    check(x.shape() == inputs[0].shape(), "[add] shapes differ: ", to_string(inputs[0].shape()), " and ",
          to_string(x.shape()));
  }
  Tensor y = inputs[0].clone();
  for (std::size_t i = 1; i < inputs.size(); ++i) autograd::accumulate(y, inputs[i]);
  return autograd::record(y, inputs, [count = inputs.size()](const Tensor& dy, autograd::Gradients& g) {
    for (std::size_t i = 0; i < count; ++i) g.add(i, dy);
  });
}

Tensor concat(const std::vector<Tensor>& inputs) {
  check(!inputs.empty(), "[concat] needs at least one input");
  const Index rows = leading("concat", inputs[0]);
  Shape shape = inputs[0].shape();
  std::vector<Index> widths;
  shape.back() = 0;
  for (const Tensor& x : inputs) {
    check_operands("concat", {inputs[0], x});
    check(x.rank() == inputs[0].rank() && std::equal(shape.begin(), shape.end() - 1, x.shape().begin()),
          "[concat] shapes differ before the last axis: ", to_string(inputs[0].shape()), " and ", to_string(x.shape()));
    widths.push_back(x.dim(-1));
    shape.back() += x.dim(-1);
  }
  const Index total = shape.back();
  Tensor y = Tensor::empty(shape, inputs[0].dtype());
  with_dtype(y.dtype(), [&]<class T>() {
    Index at = 0;
    for (std::size_t i = 0; i < inputs.size(); at += widths[i++])
      copy_rows(rows, widths[i], inputs[i].data<T>(), widths[i], y.data<T>() + at, total);
  });
  return autograd::record(y, inputs, [rows, widths, total, shape](const Tensor& dy, autograd::Gradients& g) {
    with_dtype(dy.dtype(), [&]<class T>() {
      Index at = 0;
      for (std::size_t i = 0; i < widths.size(); at += widths[i++]) {
        if (!g.wants(i)) continue;
        Shape part = shape;
        part.back() = widths[i];
        Tensor dx = Tensor::empty(part, dy.dtype());
        copy_rows(rows, widths[i], dy.data<T>() + at, total, dx.data<T>(), widths[i]);
        g.add(i, dx);
      }
    });
  });
}

}  // namespace svnet::ops
