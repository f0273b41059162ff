#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/kernels/int8/int8_gemm.cpp"
#include "nn/kernels/int8/int8_gemm.h"

#include <algorithm>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "nn/kernels/packed/panel.h"

#ifndef SVNET_INT8_ROW_PANELS
#define SVNET_INT8_ROW_PANELS
namespace svnet::kernels {
/// Panels that one row is multiplied with at once: enough sums to hide the time of a multiplication.
inline constexpr Index kRowPanels = 4;
}  // namespace svnet::kernels
#endif

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {

/// to (rows, 16) = panel (rows, 16) · scales (16).
void panel_from_int8(const std::int8_t* panel, Index rows, const float* scales, float* to) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::CappedTag<float, kPanel> floats;
  const hn::Rebind<std::int32_t, decltype(floats)> wide;
  const hn::Rebind<std::int8_t, decltype(floats)> narrow;
  const auto lanes = static_cast<Index>(hn::Lanes(floats));
  for (Index column = 0; column < kPanel; column += lanes) {
    const auto scale = hn::Load(floats, scales + column);
    for (Index row = 0; row < rows; ++row) {
      const Index at = row * kPanel + column;
      const auto values = hn::ConvertTo(floats, hn::PromoteTo(wide, hn::LoadU(narrow, panel + at)));
      hn::Store(hn::Mul(values, scale), floats, to + at);
    }
  }
}

/// kRows rows of the product with `count` panels, `count` in [1, kRowPanels], that are panel_stride bytes apart.
/// Weights become f32 in registers, once for all rows. a (rows, depth), sums (rows, kRowPanels, 16).
template <int kRows>
void rows_times_int8(const float* a, Index depth, const std::int8_t* panel, Index panel_stride, Index count,
                     const float* scales, float* sums) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::CappedTag<float, kPanel> floats;
  const hn::Rebind<std::int32_t, decltype(floats)> wide;
  const hn::Rebind<std::int8_t, decltype(floats)> narrow;
  const auto lanes = static_cast<Index>(hn::Lanes(floats));
  const Index last = count - 1;
  for (Index column = 0; column < kPanel; column += lanes) {
    const auto at = [&](Index p) { return std::min(p, last); };  // panels that are not there repeat the last one
    const std::int8_t* from[kRowPanels];
    for (Index p = 0; p < kRowPanels; ++p) from[p] = panel + at(p) * panel_stride + column;
    const auto scale = [&](Index p) { return hn::Load(floats, scales + at(p) * kPanel + column); };
    const auto s0 = scale(0), s1 = scale(1), s2 = scale(2), s3 = scale(3);
    const auto weight = [&](Index p, Index k, auto factor) {
      return hn::Mul(hn::ConvertTo(floats, hn::PromoteTo(wide, hn::LoadU(narrow, from[p] + k * kPanel))), factor);
    };
    hn::Vec<decltype(floats)> y0[kRows], y1[kRows], y2[kRows], y3[kRows];
    for (int row = 0; row < kRows; ++row) y0[row] = y1[row] = y2[row] = y3[row] = hn::Zero(floats);
    for (Index k = 0; k < depth; ++k) {
      const auto w0 = weight(0, k, s0), w1 = weight(1, k, s1), w2 = weight(2, k, s2), w3 = weight(3, k, s3);
      for (int row = 0; row < kRows; ++row) {
        const auto x = hn::Set(floats, a[row * depth + k]);
        y0[row] = hn::MulAdd(x, w0, y0[row]);
        y1[row] = hn::MulAdd(x, w1, y1[row]);
        y2[row] = hn::MulAdd(x, w2, y2[row]);
        y3[row] = hn::MulAdd(x, w3, y3[row]);
      }
    }
    for (int row = 0; row < kRows; ++row) {
      float* const to = sums + row * kRowPanels * kPanel + column;
      hn::Store(y0[row], floats, to);
      hn::Store(y1[row], floats, to + kPanel);
      hn::Store(y2[row], floats, to + 2 * kPanel);
      hn::Store(y3[row], floats, to + 3 * kPanel);
    }
  }
}

void row_times_int8(const float* a, Index depth, const std::int8_t* panel, Index panel_stride, Index count,
                    const float* scales, float* sums) {
  rows_times_int8<1>(a, depth, panel, panel_stride, count, scales, sums);
}
void three_rows_times_int8(const float* a, Index depth, const std::int8_t* panel, Index panel_stride, Index count,
                           const float* scales, float* sums) {
  rows_times_int8<3>(a, depth, panel, panel_stride, count, scales, sums);
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "nn/kernels/int8/int8_weights.h"
#include "nn/kernels/packed/tile_kernels.h"

namespace svnet::kernels {

HWY_EXPORT(panel_from_int8);
HWY_EXPORT(row_times_int8);
HWY_EXPORT(three_rows_times_int8);

namespace {

constexpr Index kBlock = kPackedDepth * kPanel;  // floats of a panel that is converted at once

/// `count` panels from p on, for `rows` rows of a, which are `depth` apart.
void multiply_int8(const TileKernels& kernels, Index count, Index rows, const float* a, const PackedInt8& weights,
                   Index p, const PackedFinish& finish, float* c, float* block) {
  const auto [low, high] = range_of(finish.clamp);
  const Index depth = weights.depth, n = weights.n;
  const TileFinish tile_finish{weights.bias.get() + p * kPanel,
                               finish.residual == nullptr ? nullptr : finish.residual + p * kPanel, n, low, high};
  for (Index begin = 0; begin < depth; begin += kPackedDepth) {
    const Index run = std::min(kPackedDepth, depth - begin);
    for (Index i = 0; i < count; ++i) HWY_DYNAMIC_DISPATCH(panel_from_int8)
    (weights.panels.get() + ((p + i) * depth + begin) * kPanel, run, weights.scales.get() + (p + i) * kPanel,
     block + i * kBlock);
    multiply_panels(kernels, count, rows, {a + begin, depth, kPanel}, run, block, kBlock,
                    {.c = c + p * kPanel,
                     .stride = n,
                     .accumulate = begin > 0,
                     .finish = begin + run == depth ? &tile_finish : nullptr,
                     .columns = n - p * kPanel});
  }
}

/// One or three rows with `count` panels from p on. With so few rows, weights that go through memory would take most of
/// the time.
void multiply_rows(Index rows, const float* a, const PackedInt8& weights, Index p, Index count,
                   const PackedFinish& finish, float* c) {
  const auto [low, high] = range_of(finish.clamp);
  const Index depth = weights.depth, n = weights.n;
  alignas(64) float sums[3 * kRowPanels * kPanel];
  const std::int8_t* const panel = weights.panels.get() + p * depth * kPanel;
  const float* const scales = weights.scales.get() + p * kPanel;
  if (rows == 3)
    HWY_DYNAMIC_DISPATCH(three_rows_times_int8)(a, depth, panel, depth * kPanel, count, scales, sums);
  else
    HWY_DYNAMIC_DISPATCH(row_times_int8)(a, depth, panel, depth * kPanel, count, scales, sums);
  const Index first = p * kPanel, columns = std::min(count * kPanel, n - first);
  for (Index row = 0; row < rows; ++row)
    for (Index i = 0; i < columns; ++i) {
      const Index to = row * n + first + i;
      float y = sums[row * kRowPanels * kPanel + i] + weights.bias.get()[first + i];
      if (finish.residual != nullptr) y += finish.residual[to];
      y = y < low ? low : y;
      c[to] = y > high ? high : y;
    }
}

constexpr Index kFewRows = 6;

}  // namespace

PackedInt8 packed_int8(Index depth, Index n, const float* w, const float* bias) {
  const Index padded = panels(n) * kPanel;
  const auto bytes = static_cast<std::size_t>(padded * depth);
  auto* memory = static_cast<std::int8_t*>(aligned_memory(bytes));
  if (memory == nullptr) throw NoMemory(bytes);
  PackedInt8 packed{.depth = depth,
                    .n = n,
                    .panels = std::unique_ptr<std::int8_t[], FreeAligned>(memory),
                    .scales = aligned_floats(padded),
                    .bias = aligned_floats(padded)};
  const Int8Weights weights = int8_weights({.outer = depth, .channels = n}, w);
  std::fill_n(packed.scales.get(), padded, 1.0f);
  std::ranges::copy(weights.scales, packed.scales.get());
  std::fill_n(packed.bias.get(), padded, 0.0f);
  if (bias != nullptr) std::copy_n(bias, n, packed.bias.get());
  for (Index p = 0; p < panels(n); ++p) {
    const Index columns = std::min(kPanel, n - p * kPanel);
    for (Index row = 0; row < depth; ++row) {
      std::int8_t* to = packed.panels.get() + (p * depth + row) * kPanel;
      std::copy_n(weights.values.data() + row * n + p * kPanel, columns, to);
      std::fill_n(to + columns, kPanel - columns, std::int8_t{0});
    }
  }
  return packed;
}

void int8_gemm(Parallel& parallel, Index rows, const float* a, const PackedInt8& weights, const PackedFinish& finish,
               float* c, float* scratch) {
  if (rows <= kFewRows) {
    const Index all = panels(weights.n);
    return parallel.for_chunks(all, kRowPanels, [&](Index first, Index last, int) {
      for (Index row = 0; row < rows;) {
        const Index together = rows - row >= 3 ? 3 : 1;
        PackedFinish here = finish;
        if (here.residual != nullptr) here.residual += row * weights.n;
        multiply_rows(together, a + row * weights.depth, weights, first, last - first, here, c + row * weights.n);
        row += together;
      }
    });
  }
  const TileKernels kernels = f32_tiles();
  const Index block = packed_block_rows(rows, weights.depth), blocks = (rows + block - 1) / block;
  const Index all = panels(weights.n), groups = (all + kernels.panels - 1) / kernels.panels;
  parallel.for_chunks(blocks * groups, 1, [&](Index task, Index, int worker) {
    const Index row = task / groups * block, first = task % groups * kernels.panels;
    PackedFinish here = finish;
    if (here.residual != nullptr) here.residual += row * weights.n;
    const Index count = std::min(kernels.panels, all - first);
    for (Index p = first; p < first + count; p += count == kernels.panels ? count : 1)
      multiply_int8(kernels, count == kernels.panels ? count : 1, std::min(block, rows - row), a + row * weights.depth,
                    weights, p, here, c + row * weights.n, scratch + worker * kMostTilePanels * kBlock);
  });
}

Index int8_gemm_scratch(int threads) { return threads * kMostTilePanels * kBlock; }

void copy_rows(Parallel& parallel, const PackedInt8& from, std::span<const Index> rows, PackedWeights& to) {
  parallel.for_chunks(panels(from.n), 4, [&](Index first, Index last, int) {
    for (Index p = first; p < last; ++p) {
      float* target = to.panels.get() + p * to.panel_rows * kPanel;
      for (const Index row : rows) {
        HWY_DYNAMIC_DISPATCH(panel_from_int8)
        (from.panels.get() + (p * from.depth + row) * kPanel, 1, from.scales.get() + p * kPanel, target);
        target += kPanel;
      }
    }
  });
}

}  // namespace svnet::kernels
#endif
