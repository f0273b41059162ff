#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/kernels/adam/adam_product.cpp"
#include "nn/kernels/adam/adam_product.h"

#include <algorithm>

#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/aligned.h"
#include "nn/kernels/adam/adam_run-inl.h"
#include "nn/kernels/packed/micro_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {

/// Rows [begin, end) of the parameter: columns in runs of `width`, a multiple of 16. xt (C, M), dy in panels.
void adam_product_rows(const AdamStep& step, const AdamProductShape& s, Index begin, Index end, Index width,
                       const float* xt, const float* dy, float* parameter, float* m, float* v, float* gradient) {
  for (Index column = 0; column < s.k; column += width) {
    const Index columns = HWY_MIN(width, s.k - column);
    for (Index p = 0; p < panels(columns); ++p) {
      // What the step will read comes from memory while its gradient is computed.
      for (Index row = begin; row < end; ++row)
        for (const float* numbers : {parameter, m, v}) hwy::Prefetch(numbers + row * s.k + column + p * kPanel);
      multiply_panel(end - begin, {xt + begin * s.m, s.m, kPanel}, s.m, dy + (column / kPanel + p) * s.m * kPanel,
                     {gradient + p * kPanel, width});
    }
    for (Index row = begin; row < end; ++row) {
      const Index at = row * s.k + column;
      adam_run(step, columns, gradient + (row - begin) * width, parameter + at, m + at, v + at);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "nn/kernels/packed/packed_weights.h"

namespace svnet::kernels {

HWY_EXPORT(adam_product_rows);

void adam_product(Parallel& parallel, const AdamStep& step, const AdamProductShape& s, const float* x, const float* dy,
                  float* parameter, float* m, float* v) {
  // In L2: 48 KiB of gradient, 144 KiB of numbers on their way, and 64 KiB of dy for 32 rows.
  constexpr Index kRows = 24, kWidth = 512;
  const PackedWeights packed = packed_weights(s.m, s.k, dy, nullptr);
  const AlignedFloats xt = aligned_floats(s.c * s.m);
  const AlignedFloats gradients = aligned_floats(parallel.threads() * kRows * kWidth);
  parallel.for_chunks(s.c, 256, [&](Index begin, Index end, int) {
    for (Index row = 0; row < s.m; ++row)
      for (Index c = begin; c < end; ++c) xt[c * s.m + row] = x[row * s.c + c];
  });
  parallel.for_chunks(s.c, kRows, [&](Index begin, Index end, int worker) {
    HWY_DYNAMIC_DISPATCH(adam_product_rows)
    (step, s, begin, end, kWidth, xt.get(), packed.panels.get(), parameter, m, v,
     gradients.get() + worker * kRows * kWidth);
  });
}

}  // namespace svnet::kernels
#endif
