#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/multiply_adds.cpp"
#include "bench/multiply_adds.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "nn/kernels/packed/panel_vector-inl.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::bench {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using kernels::HWY_NAMESPACE::PanelTag;
using kernels::HWY_NAMESPACE::PanelVector;
using kernels::HWY_NAMESPACE::unrolled;

/// Enough independent sums to hide the latency of a multiply-add (4 or 5 cycles, two a cycle), few enough for 16
/// registers.
inline constexpr int kSums = 12;

float run(Index rounds) {
  const PanelTag d;
  // Known to nobody at compile time; the sums stay finite.
  volatile float given = 0.5f;
  const auto factor = hn::Set(d, given), addend = hn::Set(d, given);
  PanelVector sums[kSums];
  unrolled<kSums>([&](auto i) HWY_ATTR { sums[i] = hn::Set(d, static_cast<float>(i)); });
  for (Index round = 0; round < rounds; ++round)
    unrolled<kSums>([&](auto i) HWY_ATTR { sums[i] = hn::MulAdd(sums[i], factor, addend); });
  auto all = sums[0];
  for (int i = 1; i < kSums; ++i) all = hn::Add(all, sums[i]);
  return hn::GetLane(hn::SumOfLanes(d, all));
}

double flops(Index rounds) {
  return 2.0 * kSums * static_cast<double>(rounds) * static_cast<double>(hn::Lanes(PanelTag()));
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::bench {

HWY_EXPORT(run);
HWY_EXPORT(flops);

float multiply_adds(Index rounds) { return HWY_DYNAMIC_DISPATCH(run)(rounds); }
double multiply_add_flops(Index rounds) { return HWY_DYNAMIC_DISPATCH(flops)(rounds); }

}  // namespace svnet::bench
#endif
