#pragma once
#include "base/parallel.h"

namespace svnet::kernels {

/// One step of Adam on `count` elements. `rate` is the learning rate times the bias correction:
///   m ← m + (g − m)(1 − β₁),  v ← v + (g² − v)(1 − β₂),  θ ← θ − rate · m / (√v + ε).
struct AdamStep {
  double rate, beta1, beta2, epsilon;
};

template <class T>
void adam_reference(Parallel&, const AdamStep&, Index count, const T* gradient, T* parameter, T* m, T* v);
/// The same bits as the reference's on every instruction set.
void adam(Parallel&, const AdamStep&, Index count, const float* gradient, float* parameter, float* m, float* v);
inline void adam(Parallel& parallel, const AdamStep& step, Index count, const double* gradient, double* parameter,
                 double* m, double* v) {
  adam_reference(parallel, step, count, gradient, parameter, m, v);
}

/// adam on the calling thread.
void adam_serial(const AdamStep&, Index count, const float* gradient, float* parameter, float* m, float* v);

}  // namespace svnet::kernels
