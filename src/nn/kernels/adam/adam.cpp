#include "nn/kernels/adam/adam.h"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/kernels/adam/adam.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// No fused multiply-add: every instruction set gives the bits of the reference.
void adam_run(const AdamStep& step, Index count, const float* HWY_RESTRICT gradient, float* HWY_RESTRICT parameter,
              float* HWY_RESTRICT m, float* HWY_RESTRICT v) {
  const hn::ScalableTag<float> d;
  const Index lanes = static_cast<Index>(hn::Lanes(d));
  const auto keep1 = static_cast<float>(1 - step.beta1), keep2 = static_cast<float>(1 - step.beta2);
  const auto rate = static_cast<float>(step.rate), epsilon = static_cast<float>(step.epsilon);
  Index i = 0;
  for (; i + lanes <= count; i += lanes) {
    const auto g = hn::LoadU(d, gradient + i);
    auto first = hn::LoadU(d, m + i), second = hn::LoadU(d, v + i);
    first = hn::Add(first, hn::Mul(hn::Sub(g, first), hn::Set(d, keep1)));
    second = hn::Add(second, hn::Mul(hn::Sub(hn::Mul(g, g), second), hn::Set(d, keep2)));
    hn::StoreU(first, d, m + i);
    hn::StoreU(second, d, v + i);
    const auto change = hn::Div(hn::Mul(hn::Set(d, rate), first), hn::Add(hn::Sqrt(second), hn::Set(d, epsilon)));
    hn::StoreU(hn::Sub(hn::LoadU(d, parameter + i), change), d, parameter + i);
  }
  for (; i < count; ++i) {
    m[i] += (gradient[i] - m[i]) * keep1;
    v[i] += (gradient[i] * gradient[i] - v[i]) * keep2;
    parameter[i] -= rate * m[i] / (std::sqrt(v[i]) + epsilon);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::kernels {

HWY_EXPORT(adam_run);

void adam_serial(const AdamStep& step, Index count, const float* gradient, float* parameter, float* m, float* v) {
  HWY_DYNAMIC_DISPATCH(adam_run)(step, count, gradient, parameter, m, v);
}

namespace {
constexpr Index kChunk = 1 << 14;
}

void adam(Parallel& parallel, const AdamStep& step, Index count, const float* gradient, float* parameter, float* m,
          float* v) {
  parallel.for_chunks(count, kChunk, [&](Index begin, Index end, int) {
    adam_serial(step, end - begin, gradient + begin, parameter + begin, m + begin, v + begin);
  });
}

template <class T>
void adam_reference(Parallel& parallel, const AdamStep& step, Index count, const T* gradient, T* parameter, T* m,
                    T* v) {
  const T keep1 = static_cast<T>(1 - step.beta1), keep2 = static_cast<T>(1 - step.beta2);
  const T rate = static_cast<T>(step.rate), epsilon = static_cast<T>(step.epsilon);
  parallel.for_chunks(count, kChunk, [&](Index begin, Index end, int) {
    for (Index i = begin; i < end; ++i) {
      m[i] += (gradient[i] - m[i]) * keep1;
      v[i] += (gradient[i] * gradient[i] - v[i]) * keep2;
      parameter[i] -= rate * m[i] / (std::sqrt(v[i]) + epsilon);
    }
  });
}
template void adam_reference<float>(Parallel&, const AdamStep&, Index, const float*, float*, float*, float*);
template void adam_reference<double>(Parallel&, const AdamStep&, Index, const double*, double*, double*, double*);

}  // namespace svnet::kernels
#endif
