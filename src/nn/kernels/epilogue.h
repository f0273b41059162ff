#pragma once
#include <limits>

#include "base/index.h"

namespace svnet::kernels {

/// What is applied to each element last. NaN stays NaN.
enum class Clamp { none, relu, relu6 };

/// The elements that a clamp leaves unchanged: low <= y <= high.
template <class T>
struct ClampRange {
  T low, high;

  constexpr T clamped(T y) const { return y < low ? low : y > high ? high : y; }
};

template <class T = float>
constexpr ClampRange<T> range_of(Clamp clamp) {
  constexpr T kInfinity = std::numeric_limits<T>::infinity();
  switch (clamp) {
    case Clamp::none:
      break;
    case Clamp::relu:
      return {T{0}, kInfinity};
    case Clamp::relu6:
      return {T{0}, T{6}};
  }
  return {-kInfinity, kInfinity};
}

/// What a kernel does to its output (…, K) while it is still in cache: y = clamp(y + bias), bias (K) or nullptr.
template <class T>
struct Epilogue {
  const T* bias = nullptr;
  Clamp clamp = Clamp::none;

  bool empty() const { return bias == nullptr && clamp == Clamp::none; }
};

/// Applies the epilogue to y (rows, columns), whose rows are `stride` apart. bias[0] belongs to the first column.
template <class T>
void apply_reference(const Epilogue<T>& epilogue, Index rows, Index columns, Index stride, T* y);
void apply(const Epilogue<float>& epilogue, Index rows, Index columns, Index stride, float* y);
inline void apply(const Epilogue<double>& epilogue, Index rows, Index columns, Index stride, double* y) {
  apply_reference(epilogue, rows, columns, stride, y);
}

}  // namespace svnet::kernels
