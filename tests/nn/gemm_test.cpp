#include "nn/kernels/gemm.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "nn/numbers.h"

using namespace svnet;
using namespace svnet::test;
using kernels::GemmShape;

namespace {

/// One product by gemm, by gemm_serial and by gemm_reference against the sums in f64. Rows are `slack` longer than
/// necessary; the floats between them must not change.
template <class T>
void check_product(GemmShape s, Index slack) {
  const Index a_rows = s.transpose_a ? s.k : s.m, b_rows = s.transpose_b ? s.n : s.k;
  const Index lda = (s.transpose_a ? s.m : s.k) + slack, ldb = (s.transpose_b ? s.k : s.n) + slack, ldc = s.n + slack;
  if (slack > 0) s.lda = lda, s.ldb = ldb, s.ldc = ldc;
  const Tensor a = random_tensor({a_rows, lda}, 1, kDType<T>), b = random_tensor({b_rows, ldb}, 2, kDType<T>);
  const Tensor before = random_tensor({s.m, ldc}, 3, kDType<T>);

  const Tensor wide_a = a.to(DType::f64), wide_b = b.to(DType::f64), wide_before = before.to(DType::f64);
  Tensor truth = wide_before.clone(), magnitude = absolute(wide_before);
  for (Index i = 0; i < s.m; ++i)
    for (Index j = 0; j < s.n; ++j) {
      double& sum = truth.data<double>()[i * ldc + j];
      double& size = magnitude.data<double>()[i * ldc + j];
      if (!s.accumulate) sum = size = 0;
      for (Index p = 0; p < s.k; ++p) {
        const double term = wide_a.data<double>()[s.transpose_a ? p * lda + i : i * lda + p] *
                            wide_b.data<double>()[s.transpose_b ? j * ldb + p : p * ldb + j];
        sum += term;
        size += std::abs(term);
      }
    }
  INFO(s.m << "x" << s.n << "x" << s.k << ", transposes " << s.transpose_a << s.transpose_b << ", accumulate "
           << s.accumulate << ", slack " << slack << ", " << name_of(kDType<T>));
  Tensor c = before.clone();
  kernels::gemm<T>(Parallel::shared(), s, a.data<T>(), b.data<T>(), c.data<T>());
  CHECK(error_in_epsilons(c, truth, magnitude) <= 4);
  c = before.clone();
  kernels::gemm_serial<T>(s, a.data<T>(), b.data<T>(), c.data<T>());
  CHECK(error_in_epsilons(c, truth, magnitude) <= 4);
  c = before.clone();
  kernels::gemm_reference<T>(s, a.data<T>(), b.data<T>(), c.data<T>());
  CHECK(error_in_epsilons(c, truth, magnitude) <= 4);
}

template <class T>
void check_sizes(const std::vector<GemmShape>& sizes) {
  for (const GemmShape& size : sizes)
    for (bool transpose_a : {false, true})
      for (bool transpose_b : {false, true})
        for (bool accumulate : {false, true})
          for (Index slack : {0, 3}) {
            GemmShape s = size;
            s.transpose_a = transpose_a, s.transpose_b = transpose_b, s.accumulate = accumulate;
            check_product<T>(s, slack);
          }
}

}  // namespace

TEST_CASE("gemm multiplies at odd sizes and around its tiles") {
  const std::vector<GemmShape> sizes{
      {.m = 1, .n = 1, .k = 1},   {.m = 3, .n = 5, .k = 7},     {.m = 17, .n = 63, .k = 9},
      {.m = 2, .n = 65, .k = 33}, {.m = 384, .n = 7, .k = 5},   {.m = 385, .n = 66, .k = 3},
      {.m = 771, .n = 2, .k = 4}, {.m = 5, .n = 1030, .k = 11}, {.m = 6, .n = 4, .k = 1031}};
  check_sizes<float>(sizes);
  check_sizes<double>(sizes);
}

TEST_CASE("gemm over no terms gives zeros, or the previous values if it accumulates") {
  check_sizes<float>({{.m = 3, .n = 70, .k = 0},
                      {.m = 400, .n = 2, .k = 0},
                      {.m = 0, .n = 4, .k = 5},
                      {.m = 4, .n = 0, .k = 5},
                      {.m = 400, .n = 0, .k = 5}});
}
