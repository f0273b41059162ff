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
constexpr Index kLanes = kPanel / kVectorsPerPanel;
/// Channels that are walked together.
constexpr Index kChannels = 4 * kPanel;

/// The window rows and columns that lie inside the image.
struct Taps {
  Index kh0, kh1, kw0, kw1;
};

using PixelSums = PanelVector[kPixels][kVectorsPerPanel];

template <bool kRelu>
HWY_INLINE PanelVector input_vector(const float* x) {
  const PanelTag d;
  const auto value = hn::LoadU(d, x);
  return kRelu ? at_least(hn::Zero(d), value) : value;
}

/// Adds the taps of any window to the sums of kCount neighbouring pixels; x at the first pixel's tap (0, 0), which need
/// not exist.
template <int kCount, bool kRelu>
HWY_INLINE void add_taps(const Window& win, const Taps& t, const float* taps, const float* x, PixelSums& sum) {
  const PanelTag d;
  const Index step = win.stride_w * win.c, padded = panels(win.c) * kPanel;
  for (Index kh = t.kh0; kh < t.kh1; ++kh)
    for (Index kw = t.kw0; kw < t.kw1; ++kw) {
      const float* from = x + (kh * win.w + kw) * win.c;
      const float* tap = taps + (kh * win.kw + kw) * padded;
      unrolled<kVectorsPerPanel>([&](auto v) HWY_ATTR {
        const auto w = hn::Load(d, tap + v * kLanes);
        unrolled<kCount>([&](auto p) HWY_ATTR {
          sum[p][v] = hn::MulAdd(input_vector<kRelu>(from + p * step + v * kLanes), w, sum[p][v]);
        });
      });
    }
}

/// Where a run of kPixels windows of width 3 and stride 1 lies in its row of the image: windows at the row's ends reach
/// one column out of it.
enum Edges { kInner = 0, kLeftmost = 1, kRightmost = 2 };

/// The same for such a run: each input is read once for the three pixels that share it.
template <bool kRelu, int kEdges>
HWY_INLINE void add_rows_of_three(const Window& win, const Taps& t, const float* taps, const float* x, PixelSums& sum) {
  const PanelTag d;
  const Index padded = panels(win.c) * kPanel;
  const float* from = x + t.kh0 * win.w * win.c;
  const float* tap = taps + t.kh0 * 3 * padded;
  for (Index kh = t.kh0; kh < t.kh1; ++kh, from += win.w * win.c, tap += 3 * padded) {
    PanelVector w[3][kVectorsPerPanel];
    unrolled<3>([&](auto kw) HWY_ATTR {
      unrolled<kVectorsPerPanel>([&](auto v) HWY_ATTR { w[kw][v] = hn::Load(d, tap + kw * padded + v * kLanes); });
    });
    unrolled<kPixels + 2>([&](auto j) HWY_ATTR {
      if constexpr (!((kEdges & kLeftmost) != 0 && j == 0) && !((kEdges & kRightmost) != 0 && j == kPixels + 1))
        unrolled<kVectorsPerPanel>([&](auto v) HWY_ATTR {
          const auto value = input_vector<kRelu>(from + j * win.c + v * kLanes);
          unrolled<3>([&](auto kw) HWY_ATTR {
            constexpr int p = j - kw;
            if constexpr (p >= 0 && p < kPixels) sum[p][v] = hn::MulAdd(value, w[kw][v], sum[p][v]);
          });
        });
    });
  }
}

/// A window row as one of four kinds: any window, or a run for add_rows_of_three.
constexpr int kAnyWindow = -1;

/// kCount neighbouring output pixels, one panel of channels.
template <int kCount, bool kRelu, int kEdges>
HWY_INLINE void depthwise_pixels(const Window& win, const Taps& t, const DepthwiseTaps& weights, const float* x,
                                 Index c, PanelVector low, PanelVector high, float* y) {
  const PanelTag d;
  PixelSums sum;
  unrolled<kCount>([&](auto p) HWY_ATTR {
    unrolled<kVectorsPerPanel>([&](auto v) HWY_ATTR { sum[p][v] = hn::Load(d, weights.bias.get() + c + v * kLanes); });
  });
  if constexpr (kEdges == kAnyWindow)
    add_taps<kCount, kRelu>(win, t, weights.taps.get() + c, x + c, sum);
  else
    add_rows_of_three<kRelu, kEdges>(win, t, weights.taps.get() + c, x + c, sum);
  unrolled<kCount>([&](auto p) HWY_ATTR {
    unrolled<kVectorsPerPanel>(
        [&](auto v) HWY_ATTR { hn::Store(clamped(sum[p][v], low, high), d, y + p * kPanel + v * kLanes); });
  });
}

/// Where the channels [c0, c1) of a run of pixels come from and go to: x at the first pixel's tap (0, 0), panels of y
/// `apart` pixels from each other.
struct Run {
  const float* x;
  Index c0, c1;
  float* y;
  Index apart;
};

template <int kCount, bool kRelu, int kEdges = kAnyWindow>
HWY_NOINLINE void depthwise_run(const Window& win, const Taps& t, const DepthwiseTaps& weights, const Run& run) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const PanelTag d;
  const auto low = hn::Set(d, weights.clamp == Clamp::none ? -kInfinity : 0.0f);
  const auto high = hn::Set(d, weights.clamp == Clamp::relu6 ? 6.0f : kInfinity);
  for (Index c = run.c0; c < run.c1; c += kPanel)
    depthwise_pixels<kCount, kRelu, kEdges>(win, t, weights, run.x, c, low, high, run.y + (c - run.c0) * run.apart);
}

/// By Edges.
template <bool kRelu>
constexpr decltype(&depthwise_run<kPixels, kRelu>) kRunsOfThree[] = {
    &depthwise_run<kPixels, kRelu, kInner>, &depthwise_run<kPixels, kRelu, kLeftmost>,
    &depthwise_run<kPixels, kRelu, kRightmost>, &depthwise_run<kPixels, kRelu, kLeftmost | kRightmost>};

/// Output positions [begin, end) as [C / 16][end - begin][16].
template <bool kRelu>
HWY_INLINE void depthwise_block(const Window& win, const DepthwiseTaps& weights, const float* x, Index begin, Index end,
                                float* y) {
  const auto [inner0, inner1] = win.inner_columns();
  // Then add_rows_of_three serves every column of a row.
  const bool threes = win.kw == 3 && win.stride_w == 1 && inner0 <= 1 && inner1 >= win.ow - 1;
  // A few panels of channels together: each pixel is then some lines in a row, which the hardware fetches ahead.
  for (Index c0 = 0; c0 < win.c; c0 += kChannels) {
    const Index c1 = HWY_MIN(c0 + kChannels, win.c);
    float* to = y + c0 * (end - begin);
    for (Index position = begin; position < end;) {
      const Index row = position / win.ow, n = row / win.oh, h = row % win.oh * win.stride_h - win.top;
      const Index start = position % win.ow, stop = HWY_MIN(win.ow, start + end - position);
      const Index inside0 = threes ? start : HWY_MAX(start, inner0), inside1 = threes ? stop : HWY_MIN(stop, inner1);
      const Taps taps{HWY_MAX(Index{0}, -h), HWY_MIN(win.kh, win.h - h), 0, win.kw};
      const float* image_row = x + ((n * win.h + h) * win.w - win.left) * win.c;
      const Index step = win.stride_w * win.c, apart = end - begin;
      for (Index ow = start; ow < stop;) {
        if (ow >= inside0 && ow < inside1 && inside1 - inside0 >= kPixels) {
          // The last few share a run with some that are done already.
          const Index first = HWY_MIN(ow, inside1 - kPixels);
          const Run run{image_row + first * step, c0, c1, to + (first - start) * kPanel, apart};
          if (threes)
            kRunsOfThree<kRelu>[(first < inner0 ? kLeftmost : kInner) +
                                (first + kPixels > inner1 ? kRightmost : kInner)](win, taps, weights, run);
          else
            depthwise_run<kPixels, kRelu>(win, taps, weights, run);
          ow = first + kPixels;
          continue;
        }
        const Index column = ow * win.stride_w - win.left;
        Taps edge = taps;
        edge.kw0 = HWY_MAX(Index{0}, -column);
        edge.kw1 = HWY_MIN(win.kw, win.w - column);
        depthwise_run<1, kRelu>(win, edge, weights, {image_row + ow * step, c0, c1, to + (ow - start) * kPanel, apart});
        ++ow;
      }
      to += (stop - start) * kPanel;
      position += stop - start;
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
