#pragma once
#include "base/index.h"
#include "base/parallel.h"

namespace svnet::kernels {

/// c (m, n) = a (m, k) · b (k, n), row-major; a is stored (k, m) with transpose_a, b (n, k) with transpose_b.
/// Leading dimensions 0 mean dense rows. With accumulate, c += a · b.
struct GemmShape {
  Index m = 0, n = 0, k = 0;
  bool transpose_a = false, transpose_b = false, accumulate = false;
  Index lda = 0, ldb = 0, ldc = 0;
};

/// On the calling thread, by OpenBLAS. T is float or double.
template <class T>
void gemm_serial(const GemmShape& shape, const T* a, const T* b, T* c);

/// In parallel over tiles of c. Their size depends only on the shape: the same bits for any number of threads.
template <class T>
void gemm(Parallel& parallel, const GemmShape& shape, const T* a, const T* b, T* c);

/// Three plain loops with sums in order of k: the test oracle.
template <class T>
void gemm_reference(const GemmShape& shape, const T* a, const T* b, T* c);

}  // namespace svnet::kernels
