#include "nn/kernels/adam/adam_product.h"

#include <algorithm>

#include <hwy/cache_control.h>

#include "base/aligned.h"
#include "nn/kernels/packed/packed_weights.h"
#include "nn/kernels/packed/tile_kernels.h"

namespace svnet::kernels {
namespace {

/// Rows [begin, end) of the parameter, in runs of `width` columns, a multiple of 16. xt is (C, M), dy in panels;
/// gradient (end - begin, width) is scratch.
void adam_product_rows(const AdamStep& step, const AdamProductShape& s, Index begin, Index end, Index width,
                       const float* xt, const float* dy, float* parameter, float* m, float* v, float* gradient) {
  const TileKernels kernels = f32_tiles();
  for (Index column = 0; column < s.k; column += width) {
    const Index columns = std::min(width, s.k - column);
    for (Index p = 0; p < panels(columns); ++p) {
      // The step's operands are fetched from memory while its gradient is computed.
      for (Index row = begin; row < end; ++row)
        for (const float* operand : {parameter, m, v}) hwy::Prefetch(operand + row * s.k + column + p * kPanel);
      multiply_panels(kernels, 1, end - begin, {xt + begin * s.m, s.m, kPanel}, s.m,
                      dy + (column / kPanel + p) * s.m * kPanel, 0, {gradient + p * kPanel, width});
    }
    for (Index row = begin; row < end; ++row) {
      const Index at = row * s.k + column;
      adam_serial(step, columns, gradient + (row - begin) * width, parameter + at, m + at, v + at);
    }
  }
}

}  // namespace

void adam_product(Parallel& parallel, const AdamStep& step, const AdamProductShape& s, const float* x, const float* dy,
                  float* parameter, float* m, float* v) {
  // In L2: 48 KiB of gradient, 144 KiB of fetched operands, and 64 KiB of dy for 32 rows.
  constexpr Index kRows = 24, kWidth = 512;
  const PackedWeights packed = packed_weights(s.m, s.k, dy, nullptr);
  const AlignedFloats xt = aligned_floats(s.c * s.m);
  const AlignedFloats gradients = aligned_floats(parallel.threads() * kRows * kWidth);
  parallel.for_chunks(s.c, 256, [&](Index begin, Index end, int) {
    for (Index row = 0; row < s.m; ++row)
      for (Index c = begin; c < end; ++c) xt[c * s.m + row] = x[row * s.c + c];
  });
  parallel.for_chunks(s.c, kRows, [&](Index begin, Index end, int worker) {
    adam_product_rows(step, s, begin, end, kWidth, xt.get(), packed.panels.get(), parameter, m, v,
                      gradients.get() + worker * kRows * kWidth);
  });
}

}  // namespace svnet::kernels
