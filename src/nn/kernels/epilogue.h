#pragma once
#include "base/index.h"

namespace svnet::kernels {

/// What is applied to each number last. NaN stays NaN.
enum class Clamp { none, relu, relu6 };

/// What a kernel does to its output (…, K) while it is still in cache: y = clamp(y + bias), bias (K) or nullptr.
template <class T>
struct Epilogue {
  const T* bias = nullptr;
  Clamp clamp = Clamp::none;

  bool empty() const { return bias == nullptr && clamp == Clamp::none; }
};

/// Applies the epilogue to `rows` rows of `columns` numbers that are `stride` apart; bias is that of the first column.
template <class T>
void apply_reference(const Epilogue<T>& epilogue, Index rows, Index columns, Index stride, T* y);
void apply(const Epilogue<float>& epilogue, Index rows, Index columns, Index stride, float* y);
inline void apply(const Epilogue<double>& epilogue, Index rows, Index columns, Index stride, double* y) {
  apply_reference(epilogue, rows, columns, stride, y);
}

}  // namespace svnet::kernels
