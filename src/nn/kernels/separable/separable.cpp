#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/kernels/separable/separable.cpp"
#include "nn/kernels/separable/separable.h"

#include <algorithm>
#include <limits>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "nn/kernels/packed/micro_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {

/// Pixels whose sums are kept in registers together: they share the loads of the taps.
constexpr int kPixels = 4;
/// Channels that are walked together.
constexpr Index kChannels = 4 * kPanel;

/// The window rows and columns that lie inside the image.
struct Taps {
  Index kh0, kh1, kw0, kw1;
};

/// kCount neighbouring output pixels, one panel of channels; x at the first pixel's tap (0, 0), which need not exist.
template <int kCount, bool kRelu>
HWY_INLINE void depthwise_pixels(const Window& win, const Taps& t, const DepthwiseTaps& weights, const float* x,
                                 Index c, PanelVector low, PanelVector high, float* y) {
  const PanelTag d;
  constexpr Index kLanes = kPanel / kVectorsPerPanel;
  const Index step = win.stride_w * win.c, padded = panels(win.c) * kPanel;
  PanelVector sum[kCount][kVectorsPerPanel];
  unrolled<kCount>([&](auto p) HWY_ATTR {
    unrolled<kVectorsPerPanel>([&](auto v) HWY_ATTR { sum[p][v] = hn::Load(d, weights.bias.get() + c + v * kLanes); });
  });
  for (Index kh = t.kh0; kh < t.kh1; ++kh)
    for (Index kw = t.kw0; kw < t.kw1; ++kw) {
      const float* from = x + (kh * win.w + kw) * win.c + c;
      const float* tap = weights.taps.get() + (kh * win.kw + kw) * padded + c;
      unrolled<kVectorsPerPanel>([&](auto v) HWY_ATTR {
        const auto w = hn::Load(d, tap + v * kLanes);
        unrolled<kCount>([&](auto p) HWY_ATTR {
          auto value = hn::LoadU(d, from + p * step + v * kLanes);
          if constexpr (kRelu) value = hn::Max(hn::Zero(d), value);  // in this order NaN stays NaN
          sum[p][v] = hn::MulAdd(value, w, sum[p][v]);
        });
      });
    }
  unrolled<kCount>([&](auto p) HWY_ATTR {
    unrolled<kVectorsPerPanel>([&](auto v) HWY_ATTR {
      auto value = sum[p][v];
      value = hn::IfThenElse(hn::Lt(value, low), low, value);
      hn::Store(hn::IfThenElse(hn::Gt(value, high), high, value), d, y + p * kPanel + v * kLanes);
    });
  });
}

/// Output positions [begin, end) as [C / 16][end - begin][16].
template <bool kRelu>
HWY_INLINE void depthwise_block(const Window& win, const DepthwiseTaps& weights, const float* x, Index begin, Index end,
                                float* y) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const PanelTag d;
  const auto low = hn::Set(d, weights.clamp == Clamp::none ? -kInfinity : 0.0f);
  const auto high = hn::Set(d, weights.clamp == Clamp::relu6 ? 6.0f : kInfinity);
  // Output columns whose windows lie wholly inside the image are [inner0, inner1).
  const Index inner0 = (win.left + win.stride_w - 1) / win.stride_w;
  const Index inner1 = win.w + win.left >= win.kw ? (win.w + win.left - win.kw) / win.stride_w + 1 : 0;
  // A few panels of channels together: each pixel is then some lines in a row, which the hardware fetches ahead.
  for (Index c0 = 0; c0 < win.c; c0 += kChannels) {
    const Index c1 = HWY_MIN(c0 + kChannels, win.c);
    float* to = y + c0 * (end - begin);
    for (Index position = begin; position < end;) {
      const Index row = position / win.ow, n = row / win.oh, h = row % win.oh * win.stride_h - win.top;
      Index ow = position % win.ow;
      const Index stop = HWY_MIN(win.ow, ow + end - position);
      position += stop - ow;
      const Taps taps{HWY_MAX(Index{0}, -h), HWY_MIN(win.kh, win.h - h), 0, win.kw};
      const float* image_row = x + (n * win.h + h) * win.w * win.c;
      while (ow < stop) {
        const Index column = ow * win.stride_w - win.left;
        const float* from = image_row + column * win.c;
        if (ow >= inner0 && ow + kPixels <= HWY_MIN(stop, inner1)) {
          for (Index c = c0; c < c1; c += kPanel)
            depthwise_pixels<kPixels, kRelu>(win, taps, weights, from, c, low, high, to + (c - c0) * (end - begin));
          ow += kPixels;
          to += kPixels * kPanel;
          continue;
        }
        Taps edge = taps;
        edge.kw0 = HWY_MAX(Index{0}, -column);
        edge.kw1 = HWY_MIN(win.kw, win.w - column);
        for (Index c = c0; c < c1; c += kPanel)
          depthwise_pixels<1, kRelu>(win, edge, weights, from, c, low, high, to + (c - c0) * (end - begin));
        ++ow;
        to += kPanel;
      }
    }
  }
}

void depthwise_positions(const Window& win, const DepthwiseTaps& weights, const float* x, Index begin, Index end,
                         float* y) {
  if (weights.relu_input)
    depthwise_block<true>(win, weights, x, begin, end, y);
  else
    depthwise_block<false>(win, weights, x, begin, end, y);
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::kernels {

HWY_EXPORT(depthwise_positions);

DepthwiseTaps depthwise_taps(Index kh, Index kw, Index c, const float* w, const float* bias) {
  const Index padded = panels(c) * kPanel;
  DepthwiseTaps taps{.channels = c, .taps = aligned_floats(kh * kw * padded), .bias = aligned_floats(padded)};
  std::fill_n(taps.taps.get(), kh * kw * padded, 0.0f);
  std::fill_n(taps.bias.get(), padded, 0.0f);
  for (Index tap = 0; tap < kh * kw; ++tap) std::copy_n(w + tap * c, c, taps.taps.get() + tap * padded);
  if (bias != nullptr) std::copy_n(bias, c, taps.bias.get());
  return taps;
}

Index separable_scratch(const Window& window, int threads) {
  return threads * packed_block_rows(window.positions(), window.c) * panels(window.c) * kPanel;
}

void separable_conv2d(Parallel& parallel, const Window& window, const float* x, const DepthwiseTaps& depthwise,
                      const PackedWeights& pointwise, const PackedFinish& finish, float* y, float* scratch) {
  const Index block = packed_block_rows(window.positions(), window.c);
  const Index per_worker = separable_scratch(window, 1);
  parallel.for_chunks(window.positions(), block, [&](Index begin, Index end, int worker) {
    float* between = scratch + worker * per_worker;
    HWY_DYNAMIC_DISPATCH(depthwise_positions)(window, depthwise, x, begin, end, between);
    PackedFinish here = finish;
    if (here.residual != nullptr) here.residual += begin * pointwise.n;
    packed_multiply(end - begin, {between, kPanel, kPanel * (end - begin)}, pointwise, 0, panels(pointwise.n), here,
                    y + begin * pointwise.n);
  });
}

}  // namespace svnet::kernels
#endif
