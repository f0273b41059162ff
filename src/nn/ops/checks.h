#pragma once
#include <initializer_list>
#include <string>

#include "base/parallel.h"
#include "nn/tensor.h"

namespace svnet::ops {

/// The threads that operations run on.
inline Parallel& thread_pool() { return Parallel::shared(); }

/// "8x32x32x4 * 3x3x4x16".
inline std::string shapes(const Tensor& a, const Tensor& b) {
  return to_string(a.shape()) + " * " + to_string(b.shape());
}

/// Throws Error, prefixed by [op], if an operand is an empty handle or the element types differ.
void check_operands(const char* op, std::initializer_list<Tensor> operands);

/// For operations over the last axis: the number of rows, which is the product of the other sizes. Throws Error if x is
/// a scalar or the last axis is empty.
Index leading(const char* op, const Tensor& x);

}  // namespace svnet::ops
