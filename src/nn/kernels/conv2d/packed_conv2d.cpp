#include "nn/kernels/conv2d/packed_conv2d.h"

#include <algorithm>

namespace svnet::kernels {
namespace {

Index depth(const Window& w) { return w.kh * w.kw * w.c; }

/// Rows of a gathered block are this far apart.
Index row_stride(const Window& w) { return packed_row_stride(depth(w)); }

/// Floats that a worker gathers.
Index windows_size(const Window& w) { return packed_block_rows(w.positions(), depth(w)) * row_stride(w) + kPanel; }

Index scratch_per_worker(const Window& w, Precision precision) {
  const Index rows = std::max(packed_block_rows(w.positions(), depth(w)), w.ow);
  return windows_size(w) + packed_scratch(rows, depth(w), precision);
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

/// The operands of a convolution.
struct Job {
  const Window& w;
  const float* x;
  const PackedWeights& weights;
  const PackedFinish& finish;
  float* y;

  /// `rows` output positions from `begin` on. a holds their windows; `windows` is the worker's scratch memory.
  void multiply(Index begin, Index rows, const PanelRows& a, float* windows) const {
    PackedFinish here = finish;
    if (here.residual != nullptr) here.residual += begin * weights.n;
    packed_multiply(rows, a, weights, 0, panels(weights.n), here, y + begin * weights.n, windows + windows_size(w));
  }

  void multiply_gathered(Index begin, Index end, float* windows) const {
    const Index block = packed_block_rows(w.positions(), depth(w));
    for (; begin < end; begin += block) {
      const Index rows = std::min(block, end - begin);
      gather(w, x, begin, begin + rows, windows);
      multiply(begin, rows, {windows, row_stride(w), kPanel}, windows);
    }
  }
};

/// Whether output rows are long enough to be a product each, with windows that are read in place.
bool multiplies_by_rows(const Window& w) { return w.ow >= 48 && depth(w) <= kPackedDepth; }

/// One output row. Only windows that reach out of the image are gathered.
void multiply_row(const Job& job, Index row, float* windows) {
  const Window& w = job.w;
  const Index n = row / w.oh, top = row % w.oh * w.stride_h - w.top;
  const bool inside = top >= 0 && top + w.kh <= w.h;
  const auto [first, last] = inside ? w.inner_columns() : Window::Columns{0, 0};
  const Index begin = row * w.ow;
  job.multiply_gathered(begin, begin + first, windows);
  if (last > first) {
    const float* from = job.x + ((n * w.h + top) * w.w + first * w.stride_w - w.left) * w.c;
    job.multiply(begin + first, last - first, {from, w.stride_w * w.c, w.w * w.c, w.kw * w.c}, windows);
  }
  job.multiply_gathered(begin + last, begin + w.ow, windows);
}

}  // namespace

Index packed_conv2d_scratch(const Window& window, int threads, Precision precision) {
  return window.reads_in_place() ? packed_gemm_scratch(window.positions(), depth(window), precision, threads)
                                 : threads * scratch_per_worker(window, precision);
}

void packed_conv2d(Parallel& parallel, const Window& w, const float* x, const PackedWeights& weights,
                   const PackedFinish& finish, float* y, float* scratch) {
  if (w.reads_in_place()) return packed_gemm(parallel, w.positions(), x, weights, finish, y, scratch);
  const Job job{w, x, weights, finish, y};
  const auto windows = [&](int worker) { return scratch + worker * scratch_per_worker(w, weights.precision); };
  if (multiplies_by_rows(w)) {
    parallel.for_chunks(w.n * w.oh, std::max<Index>(1, 256 / w.ow), [&](Index begin, Index end, int worker) {
      for (Index row = begin; row < end; ++row) multiply_row(job, row, windows(worker));
    });
  } else {
    parallel.for_chunks(
        w.positions(), packed_block_rows(w.positions(), depth(w)),
        [&](Index begin, Index end, int worker) { job.multiply_gathered(begin, end, windows(worker)); });
  }
}

}  // namespace svnet::kernels
