#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/kernels/packed/streamed_gemm.cpp"
#include "nn/kernels/packed/streamed_gemm.h"

#include <algorithm>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "nn/kernels/packed/panel.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {

/// Rows [k0, k1) and `columns` columns of w (k, n) from `column` on, as panels [column / 16][k1 - k0][16], zero-filled.
void lay_out(const StreamedShape& s, const float* w, Index k0, Index k1, Index column, Index columns, float* block) {
  const Index all = panels(columns), whole = columns / kPanel;
  for (Index i = k0; i < k1; ++i) {
    const float* from = w + i * s.n + column;
    float* to = block + (i - k0) * kPanel;
    for (Index p = 0; p < whole; ++p) std::copy_n(from + p * kPanel, kPanel, to + p * (k1 - k0) * kPanel);
    if (whole == all) continue;
    std::fill_n(to + whole * (k1 - k0) * kPanel, kPanel, 0.0f);
    std::copy_n(from + whole * kPanel, columns - whole * kPanel, to + whole * (k1 - k0) * kPanel);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <hwy/cache_control.h>

#include "base/aligned.h"
#include "nn/kernels/packed/streamed_block.h"
#include "nn/kernels/packed/tile_kernels.h"

namespace svnet::kernels {

HWY_EXPORT(lay_out);

namespace {

/// The columns [column, column + kStreamedColumns) of c. sums (m, kStreamedColumns) and block are scratch.
void streamed_columns(const StreamedShape& s, Index column, const float* a, const float* w, float* c, float* block,
                      float* sums) {
  const TileKernels kernels = f32_tiles();
  const Index columns = std::min(kStreamedColumns, s.n - column), all = panels(columns);
  const Index tiles = all * ((s.m + kernels.rows - 1) / kernels.rows);
  for (Index k0 = 0; k0 < s.k; k0 += kStreamedDepth) {
    const Index k1 = std::min(k0 + kStreamedDepth, s.k), next_end = std::min(k1 + kStreamedDepth, s.k);
    HWY_DYNAMIC_DISPATCH(lay_out)(s, w, k0, k1, column, columns, block);
    // The next block is fetched a few rows at a time, between the products.
    const Index rows_each = (kStreamedDepth + tiles - 1) / tiles;
    Index next = k1;
    for (Index p = 0; p < all; ++p)
      for (Index row = 0; row < s.m; row += kernels.rows) {
        for (const Index stop = std::min(next + rows_each, next_end); next < stop; ++next)
          for (Index i = 0; i < columns; i += kPanel) hwy::Prefetch(w + next * s.n + column + i);
        multiply_panels(kernels, 1, std::min(kernels.rows, s.m - row), {a + row * s.k + k0, s.k, kPanel}, k1 - k0,
                        block + p * (k1 - k0) * kPanel, 0,
                        {sums + row * kStreamedColumns + p * kPanel, kStreamedColumns, k0 > 0});
      }
  }
  for (Index row = 0; row < s.m; ++row) std::copy_n(sums + row * kStreamedColumns, columns, c + row * s.n + column);
}

}  // namespace

void streamed_gemm(Parallel& parallel, const StreamedShape& shape, const float* a, const float* w, float* c) {
  if (shape.m == 0) return;
  const Index per_worker = kStreamedDepth * kStreamedColumns + shape.m * kStreamedColumns;
  const AlignedFloats scratch = aligned_floats(parallel.threads() * per_worker);
  parallel.for_chunks(shape.n, kStreamedColumns, [&](Index begin, Index, int worker) {
    float* block = scratch.get() + worker * per_worker;
    streamed_columns(shape, begin, a, w, c, block, block + kStreamedDepth * kStreamedColumns);
  });
}

}  // namespace svnet::kernels
#endif
