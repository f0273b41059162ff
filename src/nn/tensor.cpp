#include "nn/tensor.h"

#include <algorithm>
#include <cstring>

#include "nn/autograd_node.h"
#include "nn/storage.h"

namespace svnet {
namespace {

std::size_t element_size(DType dtype) { return dtype == DType::f64 ? sizeof(double) : sizeof(float); }

}  // namespace

Index element_count(const Shape& shape) {
  Index count = 1;
  for (Index size : shape)
    check(!__builtin_mul_overflow(count, size, &count), "[tensor] ", to_string(shape),
          " has more numbers than can be counted");
  return count;
}

std::string to_string(const Shape& shape) {
  if (shape.empty()) return "scalar";
  std::string text;
  for (Index size : shape) {
    if (!text.empty()) text += "x";
    text += std::to_string(size);
  }
  return text;
}

Tensor Tensor::empty(Shape shape, DType dtype) {
  for (Index size : shape) check(size >= 0, "[tensor] negative size in shape ", to_string(shape));
  Tensor tensor;
  tensor.size_ = element_count(shape);
  tensor.shape_ = std::move(shape);
  tensor.dtype_ = dtype;
  tensor.storage_ = allocate_storage(static_cast<std::size_t>(tensor.size_) * element_size(dtype));
  return tensor;
}

Tensor Tensor::zeros(Shape shape, DType dtype) {
  Tensor tensor = empty(std::move(shape), dtype);
  std::memset(tensor.storage_.get(), 0, static_cast<std::size_t>(tensor.size_) * element_size(dtype));
  return tensor;
}

Tensor Tensor::full(Shape shape, double value, DType dtype) {
  Tensor tensor = empty(std::move(shape), dtype);
  with_dtype(dtype, [&]<class T>() { std::fill_n(tensor.data<T>(), tensor.size_, static_cast<T>(value)); });
  return tensor;
}

template <class T>
Tensor Tensor::from(Shape shape, std::span<const T> values) {
  Tensor tensor = empty(std::move(shape), kDType<T>);
  check(tensor.size_ == static_cast<Index>(values.size()), "[tensor] shape ", to_string(tensor.shape_), " needs ",
        tensor.size_, " values, got ", values.size());
  std::copy(values.begin(), values.end(), tensor.data<T>());
  return tensor;
}
template Tensor Tensor::from<float>(Shape, std::span<const float>);
template Tensor Tensor::from<double>(Shape, std::span<const double>);

double Tensor::item() const {
  check(defined() && size_ == 1, "[tensor] item() needs one element, shape is ", to_string(shape_));
  return with_dtype(dtype_, [&]<class T>() { return static_cast<double>(*data<T>()); });
}

Tensor Tensor::clone() const { return to(dtype_); }

Tensor Tensor::to(DType dtype) const {
  Tensor copy = empty(shape_, dtype);
  with_dtype(dtype_, [&]<class From>() {
    with_dtype(dtype, [&]<class To>() {
      std::transform(data<From>(), data<From>() + size_, copy.data<To>(), [](From x) { return static_cast<To>(x); });
    });
  });
  return copy;
}

Tensor Tensor::detached() const { return with_node(nullptr); }

Tensor Tensor::reshaped(Shape shape) const {
  check(element_count(shape) == size_, "[tensor] cannot reshape ", to_string(shape_), " to ", to_string(shape));
  Tensor tensor = detached();
  tensor.shape_ = std::move(shape);
  return tensor;
}

Tensor Tensor::as_parameter() const { return with_node(autograd::leaf()); }

Tensor Tensor::with_node(std::shared_ptr<autograd::Node> node) const {
  Tensor tensor = *this;
  tensor.node_ = std::move(node);
  return tensor;
}

void Tensor::require(DType dtype) const {
  check(defined() && dtype == dtype_, "[tensor] ", defined() ? name_of(dtype_) : "empty", " tensor used as ",
        name_of(dtype));
}

}  // namespace svnet
