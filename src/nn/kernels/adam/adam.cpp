#include "nn/kernels/adam/adam.h"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/kernels/adam/adam.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "nn/kernels/adam/adam_run-inl.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {
void adam_numbers(const AdamStep& step, Index count, const float* gradient, float* parameter, float* m, float* v) {
  adam_run(step, count, gradient, parameter, m, v);
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::kernels {

HWY_EXPORT(adam_numbers);

namespace {
constexpr Index kChunk = 1 << 14;
}

void adam(Parallel& parallel, const AdamStep& step, Index count, const float* gradient, float* parameter, float* m,
          float* v) {
  parallel.for_chunks(count, kChunk, [&](Index begin, Index end, int) {
    HWY_DYNAMIC_DISPATCH(adam_numbers)(step, end - begin, gradient + begin, parameter + begin, m + begin, v + begin);
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
