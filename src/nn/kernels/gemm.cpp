#include "nn/kernels/gemm.h"

#include <algorithm>

#include <cblas.h>

namespace svnet::kernels {
namespace {

GemmShape with_leading_dimensions(GemmShape s) {
  if (s.lda == 0) s.lda = s.transpose_a ? s.m : s.k;
  if (s.ldb == 0) s.ldb = s.transpose_b ? s.k : s.n;
  if (s.ldc == 0) s.ldc = s.n;
  return s;
}

/// The pool is ours: OpenBLAS must not start threads of its own.
void keep_openblas_serial() {
  static const bool once = [] {
    openblas_set_num_threads(1);
    return true;
  }();
  static_cast<void>(once);
}

void blas(const GemmShape& s, const float* a, const float* b, float* c) {
  cblas_sgemm(CblasRowMajor, s.transpose_a ? CblasTrans : CblasNoTrans, s.transpose_b ? CblasTrans : CblasNoTrans,
              static_cast<int>(s.m), static_cast<int>(s.n), static_cast<int>(s.k), 1.0f, a, static_cast<int>(s.lda), b,
              static_cast<int>(s.ldb), s.accumulate ? 1.0f : 0.0f, c, static_cast<int>(s.ldc));
}

void blas(const GemmShape& s, const double* a, const double* b, double* c) {
  cblas_dgemm(CblasRowMajor, s.transpose_a ? CblasTrans : CblasNoTrans, s.transpose_b ? CblasTrans : CblasNoTrans,
              static_cast<int>(s.m), static_cast<int>(s.n), static_cast<int>(s.k), 1.0, a, static_cast<int>(s.lda), b,
              static_cast<int>(s.ldb), s.accumulate ? 1.0 : 0.0, c, static_cast<int>(s.ldc));
}

}  // namespace

template <class T>
void gemm_serial(const GemmShape& shape, const T* a, const T* b, T* c) {
  if (shape.m == 0 || shape.n == 0) return;
  keep_openblas_serial();
  blas(with_leading_dimensions(shape), a, b, c);
}

template <class T>
void gemm(Parallel& parallel, const GemmShape& shape, const T* a, const T* b, T* c) {
  if (shape.m == 0 || shape.n == 0) return;
  const GemmShape whole = with_leading_dimensions(shape);
  // Tall tiles amortise OpenBLAS' packing of b; wide ones its packing of a.
  const Index rows = std::min<Index>(whole.m, 384);
  const Index columns = whole.m > 384 ? whole.n : std::max<Index>(64, (whole.n + 15) / 16);
  const Index tiles_across = (whole.n + columns - 1) / columns;
  const Index tiles = (whole.m + rows - 1) / std::max<Index>(rows, 1) * tiles_across;
  parallel.for_chunks(tiles, 1, [&](Index tile, Index, int) {
    const Index row = tile / tiles_across * rows, column = tile % tiles_across * columns;
    GemmShape part = whole;
    part.m = std::min(rows, whole.m - row);
    part.n = std::min(columns, whole.n - column);
    gemm_serial(part, a + (whole.transpose_a ? row : row * whole.lda),
                b + (whole.transpose_b ? column * whole.ldb : column), c + row * whole.ldc + column);
  });
}

template <class T>
void gemm_reference(const GemmShape& shape, const T* a, const T* b, T* c) {
  const GemmShape s = with_leading_dimensions(shape);
  for (Index i = 0; i < s.m; ++i)
    for (Index j = 0; j < s.n; ++j) {
      T sum = s.accumulate ? c[i * s.ldc + j] : T{0};
      for (Index p = 0; p < s.k; ++p)
        sum += (s.transpose_a ? a[p * s.lda + i] : a[i * s.lda + p]) *
               (s.transpose_b ? b[j * s.ldb + p] : b[p * s.ldb + j]);
      c[i * s.ldc + j] = sum;
    }
}

template void gemm_serial<float>(const GemmShape&, const float*, const float*, float*);
template void gemm_serial<double>(const GemmShape&, const double*, const double*, double*);
template void gemm<float>(Parallel&, const GemmShape&, const float*, const float*, float*);
template void gemm<double>(Parallel&, const GemmShape&, const double*, const double*, double*);
template void gemm_reference<float>(const GemmShape&, const float*, const float*, float*);
template void gemm_reference<double>(const GemmShape&, const double*, const double*, double*);

}  // namespace svnet::kernels
