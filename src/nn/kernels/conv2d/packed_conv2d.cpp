#include "nn/kernels/conv2d/packed_conv2d.h"

#include <algorithm>

namespace svnet::kernels {
namespace {

Index depth(const Window& w) { return w.kh * w.kw * w.c; }

/// Rows of a gathered block are this far apart; not by whole pages, which would all share a few lines of the cache.
Index row_stride(const Window& w) {
  const Index whole = panels(depth(w)) * kPanel;
  return whole % 512 == 0 ? whole + kPanel : whole;
}

Index scratch_per_worker(const Window& w) {
  return packed_block_rows(w.positions(), depth(w)) * row_stride(w) + kPanel;
}

/// The windows of the output positions [begin, end), a row each; zeros in the border.
void gather(const Window& w, const float* x, Index begin, Index end, float* to) {
  const Index stride = row_stride(w), run = w.kw * w.c;
  for (Index position = begin; position < end; ++position, to += stride) {
    const Index ow = position % w.ow, oh = position / w.ow % w.oh, n = position / (w.ow * w.oh);
    const Index column = ow * w.stride_w - w.left;
    const Index kw0 = std::clamp<Index>(-column, 0, w.kw), kw1 = std::clamp<Index>(w.w - column, kw0, w.kw);
    for (Index kh = 0; kh < w.kh; ++kh) {
      const Index row = oh * w.stride_h - w.top + kh;
      float* here = to + kh * run;
      if (row < 0 || row >= w.h) {
        std::fill_n(here, run, 0.0f);
        continue;
      }
      const float* from = x + ((n * w.h + row) * w.w + column) * w.c;
      std::fill_n(here, kw0 * w.c, 0.0f);
      std::copy_n(from + kw0 * w.c, (kw1 - kw0) * w.c, here + kw0 * w.c);
      std::fill_n(here + kw1 * w.c, (w.kw - kw1) * w.c, 0.0f);
    }
  }
}

}  // namespace

Index packed_conv2d_scratch(const Window& window, int threads) {
  return window.reads_in_place() ? 0 : threads * scratch_per_worker(window);
}

void packed_conv2d(Parallel& parallel, const Window& w, const float* x, const PackedWeights& weights,
                   const PackedFinish& finish, float* y, float* scratch) {
  if (w.reads_in_place()) return packed_gemm(parallel, w.positions(), x, weights, finish, y);
  const Index block = packed_block_rows(w.positions(), depth(w));
  parallel.for_chunks(w.positions(), block, [&](Index begin, Index end, int worker) {
    float* windows = scratch + worker * scratch_per_worker(w);
    gather(w, x, begin, end, windows);
    PackedFinish here = finish;
    if (here.residual != nullptr) here.residual += begin * weights.n;
    packed_multiply(end - begin, {windows, row_stride(w), kPanel}, weights, 0, panels(weights.n), here,
                    y + begin * weights.n);
  });
}

}  // namespace svnet::kernels
