#include "nn/kernels/separable/fused_separable.h"

#include "nn/kernels/pool/inference_pool.h"

namespace svnet::kernels {
namespace {

/// Output rows of a strip: enough for an efficient product, few enough for L2.
Index separable_rows(const Window& w) { return std::clamp<Index>(224 / w.ow, 1, w.oh); }
Index pooled_rows(const Window& pool) { return std::min<Index>(2, pool.oh); }

Index whole_lines(Index floats) { return panels(floats) * kPanel; }

}  // namespace

Index expanded_separable_scratch(const Window& w, int threads, Index depth, Precision precision) {
  const Index rows = separable_rows(w);
  const Index rounded = packed_scratch(reached_rows(w, rows) * w.w, depth, precision);
  return threads * (strip_size(w, rows) + whole_lines(std::max(rounded, separable_scratch(w, 1, precision))));
}

void expanded_separable_conv2d(Parallel& parallel, const Window& window, const float* x, const PackedWeights& expansion,
                               Clamp clamp, const DepthwiseTaps& depthwise, const PackedWeights& pointwise,
                               const PackedFinish& finish, float* y, float* scratch) {
  over_strips(
      parallel, window, separable_rows(window), scratch,
      expanded_separable_scratch(window, 1, expansion.depth, pointwise.precision),
      [&](Index n, Index row0, Index row1, float* to, float* rest) {
        const float* from = x + (n * window.h + row0) * window.w * expansion.depth;
        packed_multiply((row1 - row0) * window.w, {from, expansion.depth, kPanel}, expansion, 0, panels(expansion.n),
                        {clamp, nullptr}, to, rest);
      },
      [&](const Window& strip, Index position, const float* image, float* rest) {
        PackedFinish here = finish;
        if (here.residual != nullptr) here.residual += position * pointwise.n;
        separable_positions(strip, image, depthwise, pointwise, here, 0, strip.positions(), y + position * pointwise.n,
                            rest);
      });
}

Index separable_max_pool_scratch(const Window& window, const Window& pool, int threads, Precision precision) {
  return threads * (strip_size(pool, pooled_rows(pool)) + whole_lines(separable_scratch(window, 1, precision)));
}

void separable_max_pool(Parallel& parallel, const Window& window, const float* x, const DepthwiseTaps& depthwise,
                        const PackedWeights& pointwise, Clamp clamp, const Window& pool, float* y, float* scratch) {
  over_strips(
      parallel, pool, pooled_rows(pool), scratch, separable_max_pool_scratch(window, pool, 1, pointwise.precision),
      [&](Index n, Index row0, Index row1, float* to, float* rest) {
        const Index first = n * window.oh * window.ow;
        separable_positions(window, x, depthwise, pointwise, {clamp, nullptr}, first + row0 * window.ow,
                            first + row1 * window.ow, to, rest);
      },
      [&](const Window& strip, Index position, const float* image, float*) {
        max_pool_positions(strip, 0, strip.positions(), image, y + position * pool.c);
      });
}

}  // namespace svnet::kernels
