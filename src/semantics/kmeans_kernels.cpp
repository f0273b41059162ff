#include "semantics/kmeans_kernels.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "semantics/kmeans_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svnet::semantics::kmeans {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 8>;
using Floats = hn::Rebind<float, Doubles>;

double potential_here(const float* closest, const float* row, Index n) {
  const Doubles d;
  const Floats f;
  const Index lanes = hn::Lanes(d);
  auto sum0 = hn::Zero(d), sum1 = hn::Zero(d);
  for (Index i = 0; i < n; i += 2 * lanes) {
    sum0 = hn::Add(sum0, hn::PromoteTo(d, hn::Min(hn::Load(f, closest + i), hn::Load(f, row + i))));
    sum1 = hn::Add(sum1, hn::PromoteTo(d, hn::Min(hn::Load(f, closest + i + lanes), hn::Load(f, row + i + lanes))));
  }
  return hn::GetLane(hn::SumOfLanes(d, hn::Add(sum0, sum1)));
}

void take_minimum_here(const float* row, Index n, float* closest) {
  const hn::CappedTag<float, 16> f;
  for (Index i = 0; i < n; i += hn::Lanes(f))
    hn::Store(hn::Min(hn::Load(f, closest + i), hn::Load(f, row + i)), f, closest + i);
}

void add_row_here(const float* row, double factor, Index n, double* sum) {
  const Doubles d;
  const Floats f;
  const auto by = hn::Set(d, factor);
  for (Index i = 0; i < n; i += hn::Lanes(d))
    hn::Store(hn::MulAdd(by, hn::PromoteTo(d, hn::Load(f, row + i)), hn::Load(d, sum + i)), d, sum + i);
}

void assign_here(const double* sum, Index stride, const double* scale, const double* half_spread, Index k, Index n,
                 double* nearest, double* label) {
  const Doubles d;
  const auto one = hn::Set(d, 1.0);
  for (Index i = 0; i < n; i += hn::Lanes(d)) {
    auto best = hn::Set(d, std::numeric_limits<double>::infinity()), best_index = hn::Zero(d), index = hn::Zero(d);
    for (Index c = 0; c < k; ++c, index = hn::Add(index, one)) {
      if (scale[c] == 0) continue;
      const auto mean = hn::Mul(hn::Load(d, sum + c * stride + i), hn::Set(d, scale[c]));
      const auto distance = hn::Max(hn::Zero(d), hn::Sub(mean, hn::Set(d, half_spread[c])));
      const auto nearer = hn::Lt(distance, best);
      best = hn::IfThenElse(nearer, distance, best);
      best_index = hn::IfThenElse(nearer, index, best_index);
    }
    hn::Store(best, d, nearest + i);
    hn::Store(best_index, d, label + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::semantics::kmeans
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::semantics::kmeans {

HWY_EXPORT(potential_here);
HWY_EXPORT(take_minimum_here);
HWY_EXPORT(add_row_here);
HWY_EXPORT(assign_here);

double potential(const float* closest, const float* row, Index n) {
  return HWY_DYNAMIC_DISPATCH(potential_here)(closest, row, n);
}
void take_minimum(const float* row, Index n, float* closest) {
  HWY_DYNAMIC_DISPATCH(take_minimum_here)(row, n, closest);
}
void add_row(const float* row, double factor, Index n, double* sum) {
  HWY_DYNAMIC_DISPATCH(add_row_here)(row, factor, n, sum);
}
void assign(const double* sum, Index stride, const double* scale, const double* half_spread, Index k, Index n,
            double* nearest, double* label) {
  HWY_DYNAMIC_DISPATCH(assign_here)(sum, stride, scale, half_spread, k, n, nearest, label);
}

}  // namespace svnet::semantics::kmeans
#endif
