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

constexpr auto enum_table(DType) { return std::to_array<EnumName<DType>>({{DType::f32, "f32"}, {DType::f64, "f64"}}); }

/// Sizes from the slowest to the fastest axis. Images are (N, H, W, C), convolution weights (KH, KW, C, K).
using Shape = std::vector<Index>;

/// The product of the sizes; 1 for the shape of a scalar.
Index element_count(const Shape&);
/// "8x32x32x4"; "scalar" for the empty shape.
std::string to_string(const Shape&);

namespace autograd {
class Node;
}

/// A shared handle to an array in contiguous, 64-byte-aligned storage, with its shape. A tensor that takes part in the
/// computation of a gradient also has a node of the autograd tape. Copies of a handle share the elements; there are no
/// strides and no views. Several threads may copy and read handles; elements follow the usual rules of shared memory.
class Tensor {
 public:
  /// An empty handle. Its defined() is false; all other functions require a handle that is not empty.
  Tensor() = default;

  /// Elements are not initialised.
  static Tensor empty(Shape shape, DType dtype = DType::f32);
  static Tensor zeros(Shape shape, DType dtype = DType::f32);
  static Tensor full(Shape shape, double value, DType dtype = DType::f32);
  /// A copy of `values`. Throws Error unless there are as many as the shape has elements.
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

  /// Throws Error if T is not the element type.
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
  std::span<const T> values() const&& = delete;  // the storage may be gone
  /// The only element of a tensor of one element.
  double item() const;

  /// A copy of the elements, without history.
  Tensor clone() const;
  /// A copy converted to `dtype`, without history.
  Tensor to(DType dtype) const;
  /// The same elements, without history.
  Tensor detached() const;
  /// The same elements under another shape, without history. Throws Error if the number of elements differs.
  Tensor reshaped(Shape shape) const;
  /// Whether no other handle shares the elements, so that they may be overwritten.
  bool unique() const { return storage_.use_count() == 1; }

  /// The same elements as a new leaf of the tape: a parameter that receives a gradient.
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
