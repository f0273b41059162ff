#pragma once
#include <algorithm>
#include <cmath>

#include "base/index.h"

namespace svnet::kernels {

/// 1 / (1 + exp(−x)); never overflows.
template <class T>
T sigmoid(T x) {
  const T e = std::exp(-std::abs(x));
  return x >= T{0} ? T{1} / (T{1} + e) : e / (T{1} + e);
}

/// y = exp(x) / Σ exp(x) over `classes` numbers, shifted by the largest so that it never overflows. y may be x.
template <class T>
void softmax_row(Index classes, const T* x, T* y) {
  const T largest = *std::max_element(x, x + classes);
  T sum{0};
  for (Index c = 0; c < classes; ++c) sum += y[c] = std::exp(x[c] - largest);
  for (Index c = 0; c < classes; ++c) y[c] /= sum;
}

}  // namespace svnet::kernels
