#pragma once
#include "base/parallel.h"

namespace svnet::kernels {

/// One step of Adam on `count` numbers, rate being the step size with the bias correction in it:
///   m ← m + (g − m)(1 − β₁),  v ← v + (g² − v)(1 − β₂),  θ ← θ − rate · m / (√v + ε).
struct AdamStep {
  double rate, beta1, beta2, epsilon;
};

template <class T>
void adam_reference(Parallel&, const AdamStep&, Index count, const T* gradient, T* parameter, T* m, T* v);
void adam(Parallel&, const AdamStep&, Index count, const float* gradient, float* parameter, float* m, float* v);
inline void adam(Parallel& parallel, const AdamStep& step, Index count, const double* gradient, double* parameter,
                 double* m, double* v) {
  adam_reference(parallel, step, count, gradient, parameter, m, v);
}

}  // namespace svnet::kernels
