#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/enum_names.h"
#include "base/error.h"
#include "base/index.h"

namespace svnet {

/// f32 for all real work; f64 for gradient checks.
enum class DType { f32, f64 };

template <class T>
inline constexpr DType kDType = std::is_same_v<T, double> ? DType::f64 : DType::f32;

template <>
inline constexpr auto enum_names<DType> = std::to_array<EnumName<DType>>({{DType::f32, "f32"}, {DType::f64, "f64"}});

/// Sizes from the slowest to the fastest axis. Images are (N, H, W, C), convolution weights (KH, KW, C, K).
using Shape = std::vector<Index>;

/// The product of the sizes; 1 for the shape of a scalar.
Index element_count(const Shape&);
/// "8x32x32x4"; "scalar" for the empty shape.
std::string to_string(const Shape&);

namespace autograd {
class Node;
}

/// A shared handle to contiguous numbers in 64-byte-aligned storage, with its shape, and with a node of the autograd
/// tape where a gradient flows through it. Copying a handle shares the numbers; there are no strides and no views.
/// Handles may be copied and read by several threads; the numbers follow the usual rules for shared memory.
class Tensor {
 public:
  /// Empty handle: defined() is false and nothing else may be asked of it.
  Tensor() = default;

  /// Numbers are not initialised.
  static Tensor empty(Shape shape, DType dtype = DType::f32);
  static Tensor zeros(Shape shape, DType dtype = DType::f32);
  static Tensor full(Shape shape, double value, DType dtype = DType::f32);
  /// A copy of `values`, whose number must be that of the shape (Error otherwise).
  template <class T>
  static Tensor from(Shape shape, std::span<const T> values);
  template <class T>
  static Tensor from(Shape shape, const std::vector<T>& values) {
    return from(std::move(shape), std::span<const T>(values));
  }

  bool defined() const { return storage_ != nullptr; }
  const Shape& shape() const { return shape_; }
  Index rank() const { return static_cast<Index>(shape_.size()); }
  /// Size of an axis; negative axes count from the end.
  Index dim(Index axis) const { return shape_[static_cast<std::size_t>(axis < 0 ? axis + rank() : axis)]; }
  Index size() const { return size_; }
  DType dtype() const { return dtype_; }

  /// T must be the element type (Error otherwise).
  template <class T>
  const T* data() const {
    require(kDType<T>);
    return static_cast<const T*>(storage_.get());
  }
  template <class T>
  T* data() {
    require(kDType<T>);
    return static_cast<T*>(storage_.get());
  }
  template <class T>
  std::span<const T> values() const& {
    return {data<T>(), static_cast<std::size_t>(size_)};
  }
  template <class T>
  std::span<const T> values() const&& = delete;  // the numbers would be gone
  /// The only element of a tensor of one element.
  double item() const;

  /// A copy of the numbers, without history.
  Tensor clone() const;
  /// A copy converted to `dtype`, without history.
  Tensor to(DType dtype) const;
  /// The same numbers, without history.
  Tensor detached() const;
  /// The same numbers under another shape of as many elements, without history.
  Tensor reshaped(Shape shape) const;
  /// Whether no other handle shares the numbers, so that they may be overwritten.
  bool unique() const { return storage_.use_count() == 1; }

  /// The same numbers as a new leaf of the tape: gradients with respect to it are wanted.
  Tensor as_parameter() const;
  bool wants_gradient() const { return node_ != nullptr; }
  const std::shared_ptr<autograd::Node>& node() const { return node_; }
  /// The same handle with `node` as its history; for autograd::record.
  Tensor with_node(std::shared_ptr<autograd::Node> node) const;

 private:
  void require(DType dtype) const;

  Shape shape_;
  Index size_ = 0;
  DType dtype_ = DType::f32;
  std::shared_ptr<void> storage_;
  std::shared_ptr<autograd::Node> node_;
};

/// Calls body.operator()<float>() or body.operator()<double>().
template <class Body>
decltype(auto) with_dtype(DType dtype, Body&& body) {
  return dtype == DType::f64 ? body.template operator()<double>() : body.template operator()<float>();
}

}  // namespace svnet
