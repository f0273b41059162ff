#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/kernels/separable/separable.cpp"
#include "nn/kernels/separable/separable.h"

#include <algorithm>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "nn/kernels/packed/bytes-inl.h"
#include "nn/kernels/packed/int8_tile.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {

/// Whether there are vectors. Without them the general loops serve every window.
constexpr bool kHasVectors = HWY_TARGET != HWY_SCALAR;
/// Neighbouring output pixels whose sums are kept in registers: they share the loads of the taps. Sanitizers make four
/// take minutes to compile.
#ifdef SVNET_SANITIZED
constexpr int kPixels = kHasVectors ? 2 : 1;
#else
constexpr int kPixels = kHasVectors ? 4 : 1;
#endif
/// Channels of a row that are computed before the next row is.
constexpr Index kChannels = 4 * kPanel;

/// The rows [kh0, kh1) and columns [kw0, kw1) of a window that lie inside the image.
struct Taps {
  Index kh0, kh1, kw0, kw1;
};

using PixelSums = PanelVector[kPixels][kVectorsPerPanel];

/// The bounds of a clamp in every lane.
struct VectorBounds {
  PanelVector low, high;

  explicit HWY_INLINE VectorBounds(Clamp clamp) {
    const auto limits = range_of(clamp);
    low = hn::Set(PanelTag(), limits.low);
    high = hn::Set(PanelTag(), limits.high);
  }
};

/// Stores a result: as it is, limited, or as bytes, whose own limits serve.
HWY_INLINE void store_result(PanelVector y, const VectorBounds& limits, float* to) {
  hn::Store(clamped(y, limits.low, limits.high), PanelTag(), to);
}
HWY_INLINE void store_result(PanelVector y, const VectorBounds&, std::uint8_t* to) { store_bytes(y, to); }

template <bool kRelu>
HWY_INLINE PanelVector input_vector(const float* x) {
  const PanelTag d;
  const auto value = hn::LoadU(d, x);
  return kRelu ? at_least(hn::Zero(d), value) : value;
}

/// Adds the taps of any window to the sums of kCount neighbouring pixels. x points at tap (0, 0) of the first pixel,
/// which may lie outside the image.
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

/// The channels [c0, c1) of kCount neighbouring output pixels, for any window. x points at tap (0, 0) of the first
/// pixel; the panels of y are `apart` pixels apart.
template <int kCount, bool kRelu, class Result>
HWY_NOINLINE void depthwise_pixels(const Window& win, const Taps& t, const DepthwiseTaps& weights, const float* x,
                                   Index c0, Index c1, Result* y, Index apart) {
  const PanelTag d;
  const VectorBounds limits(weights.clamp);
  for (Index c = c0; c < c1; c += kPanel, y += kPanel * apart) {
    PixelSums sum;
    unrolled<kCount>([&](auto p) HWY_ATTR {
      unrolled<kVectorsPerPanel>([&](auto v)
                                     HWY_ATTR { sum[p][v] = hn::Load(d, weights.bias.get() + c + v * kLanes); });
    });
    add_taps<kCount, kRelu>(win, t, weights.taps.get() + c, x + c, sum);
    unrolled<kCount>([&](auto p) HWY_ATTR {
      unrolled<kVectorsPerPanel>([&](auto v)
                                     HWY_ATTR { store_result(sum[p][v], limits, y + p * kPanel + v * kLanes); });
    });
  }
}

/// A run of neighbouring output pixels of one row, for windows that are three columns wide and reach at most one column
/// out of the image. x points at tap (0, 0) of the first pixel.
struct RowRun {
  const float* x;
  Index row_stride, pixel_stride;  // of x
  const float* taps;
  Index tap_stride;
  const float* bias;
  /// Whether the window of the first pixel lacks its first column, and that of the last pixel its last column.
  bool cut_left, cut_right;
};

/// One vector of channels of kPixels neighbouring pixels, from number `first` of the run on: each input is read once
/// for all pixels that share it. w holds the taps. Unless kMayBeCut, all windows lie within the image.
template <bool kRelu, int kStride, int kRows, bool kMayBeCut, class Result>
HWY_INLINE void three_columns(const RowRun& run, const float* x, Index first, bool cut_left, bool cut_right,
                              const PanelVector (&w)[kRows][3], const PanelVector bias, const VectorBounds& limits,
                              Result* y) {
  constexpr int kColumns = (kPixels - 1) * kStride + 3;
  x += first * kStride * run.pixel_stride;
  y += first * kPanel;
  PanelVector sum[kPixels];
  unrolled<kPixels>([&](auto p) HWY_ATTR { sum[p] = bias; });
  unrolled<kRows>([&](auto kh) HWY_ATTR {
    unrolled<kColumns>([&](auto j) HWY_ATTR {
      if (kMayBeCut && ((j == 0 && cut_left) || (j == kColumns - 1 && cut_right))) return;
      const auto value = input_vector<kRelu>(x + kh * run.row_stride + j * run.pixel_stride);
      unrolled<3>([&](auto kw) HWY_ATTR {
        constexpr int from = j - kw, p = from / kStride;
        if constexpr (from >= 0 && from % kStride == 0 && p < kPixels) sum[p] = hn::MulAdd(value, w[kh][kw], sum[p]);
      });
    });
  });
  unrolled<kPixels>([&](auto p) HWY_ATTR { store_result(sum[p], limits, y + p * kPanel); });
}

/// The channels [c0, c1) of `count` pixels, at least kPixels, of which kRows rows of taps lie in the image. The run's
/// x, taps and bias point at channel 0.
template <bool kRelu, int kStride, int kRows, class Result>
HWY_NOINLINE HWY_FLATTEN void row_of_threes(const RowRun& run, Index c0, Index c1, Index count,
                                            const VectorBounds& given, Result* y, Index apart) {
  const PanelTag d;
  const VectorBounds limits = given;
  const Index last = count - kPixels;
  for (Index c = c0; c < c1; c += kPanel, y += kPanel * apart)
    for (Index v = 0; v < kPanel; v += kLanes) {
      PanelVector w[kRows][3];
      unrolled<kRows>([&](auto kh) HWY_ATTR {
        unrolled<3>([&](auto kw)
                        HWY_ATTR { w[kh][kw] = hn::Load(d, run.taps + (kh * 3 + kw) * run.tap_stride + c + v); });
      });
      const auto bias = hn::Load(d, run.bias + c + v);
      const float* x = run.x + c + v;
      // The last kPixels may overlap those before them, which are then computed again.
      for (Index first = 0;; first = HWY_MIN(first + kPixels, last)) {
        const bool cut_left = run.cut_left && first == 0, cut_right = run.cut_right && first == last;
        if (HWY_UNLIKELY(cut_left || cut_right))
          three_columns<kRelu, kStride, kRows, true>(run, x, first, cut_left, cut_right, w, bias, limits, y + v);
        else
          three_columns<kRelu, kStride, kRows, false>(run, x, first, false, false, w, bias, limits, y + v);
        if (first == last) break;
      }
    }
}

/// [rows - 1]: by the number of rows of taps that lie in the image.
template <bool kRelu, int kStride, class Result>
constexpr decltype(&row_of_threes<kRelu, kStride, 3, Result>) kRowsOfThrees[] = {
    &row_of_threes<kRelu, kStride, 1, Result>, &row_of_threes<kRelu, kStride, 2, Result>,
    &row_of_threes<kRelu, kStride, 3, Result>};

/// Output positions [begin, end) as [C / 16][end - begin][16].
template <bool kRelu, class Result>
HWY_INLINE void depthwise_block(const Window& win, const DepthwiseTaps& weights, const float* x, Index begin, Index end,
                                Result* y) {
  const auto [inner0, inner1] = win.inner_columns();
  // How many columns the last window reaches out of the image.
  const Index right = (win.ow - 1) * win.stride_w - win.left + win.kw - win.w;
  const bool threes = kHasVectors && win.kw == 3 && win.kh == 3 && (win.stride_w == 1 || win.stride_w == 2) &&
                      win.left <= 1 && right <= 1;
  const VectorBounds limits(weights.clamp);
  const Index apart = end - begin, step = win.stride_w * win.c, tap_stride = panels(win.c) * kPanel;
  // A few panels of channels at a time: their part of the input rows stays in L1 from one output row to the next.
  for (Index c0 = 0; c0 < win.c; c0 += kChannels) {
    const Index c1 = HWY_MIN(c0 + kChannels, win.c);
    Result* to = y + c0 * apart;
    for (Index position = begin; position < end;) {
      const Index row = position / win.ow, n = row / win.oh, h = row % win.oh * win.stride_h - win.top;
      const Index start = position % win.ow, stop = HWY_MIN(win.ow, start + end - position);
      const Taps taps{HWY_MAX(Index{0}, -h), HWY_MIN(win.kh, win.h - h), 0, win.kw};
      const float* image_row = x + ((n * win.h + h) * win.w - win.left) * win.c;
      const auto at = [&](Index ow) { return to + (ow - start) * kPanel; };
      if (threes && stop - start >= kPixels && taps.kh1 > taps.kh0) {
        const RowRun run{.x = image_row + taps.kh0 * win.w * win.c + start * step,
                         .row_stride = win.w * win.c,
                         .pixel_stride = win.c,
                         .taps = weights.taps.get() + taps.kh0 * 3 * tap_stride,
                         .tap_stride = tap_stride,
                         .bias = weights.bias.get(),
                         .cut_left = (start < inner0),
                         .cut_right = (stop > inner1)};
        if constexpr (kHasVectors) {
          const auto& by_rows = win.stride_w == 1 ? kRowsOfThrees<kRelu, 1, Result> : kRowsOfThrees<kRelu, 2, Result>;
          by_rows[taps.kh1 - taps.kh0 - 1](run, c0, c1, stop - start, limits, to, apart);
        }
      } else {
        const Index inside0 = HWY_MAX(start, inner0), inside1 = HWY_MIN(stop, inner1);
        for (Index ow = start; ow < stop;) {
          if (ow >= inside0 && ow < inside1 && inside1 - inside0 >= kPixels) {
            // The last kPixels may overlap those before them.
            const Index first = HWY_MIN(ow, inside1 - kPixels);
            depthwise_pixels<kPixels, kRelu>(win, taps, weights, image_row + first * step, c0, c1, at(first), apart);
            ow = first + kPixels;
            continue;
          }
          const Index column = ow * win.stride_w - win.left;
          Taps edge = taps;
          edge.kw0 = HWY_MAX(Index{0}, -column);
          edge.kw1 = HWY_MIN(win.kw, win.w - column);
          depthwise_pixels<1, kRelu>(win, edge, weights, image_row + ow * step, c0, c1, at(ow), apart);
          ++ow;
        }
      }
      to += (stop - start) * kPanel;
      position += stop - start;
    }
  }
}

template <class Result>
HWY_INLINE void depthwise_to(const Window& win, const DepthwiseTaps& weights, const float* x, Index begin, Index end,
                             Result* y) {
  if (weights.relu_input)
    depthwise_block<true>(win, weights, x, begin, end, y);
  else
    depthwise_block<false>(win, weights, x, begin, end, y);
}

void depthwise_positions(const Window& win, const DepthwiseTaps& weights, const float* x, Index begin, Index end,
                         float* y) {
  depthwise_to(win, weights, x, begin, end, y);
}
void depthwise_bytes(const Window& win, const DepthwiseTaps& weights, const float* x, Index begin, Index end,
                     float* y) {
  depthwise_to(win, weights, x, begin, end, reinterpret_cast<std::uint8_t*>(y));
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::kernels {

HWY_EXPORT(depthwise_positions);
HWY_EXPORT(depthwise_bytes);

DepthwiseTaps depthwise_taps(Index kh, Index kw, Index c, const float* w, const float* bias) {
  const Index padded = panels(c) * kPanel;
  DepthwiseTaps taps{
      .channels = c, .count = kh * kw, .taps = aligned_floats(kh * kw * padded), .bias = aligned_floats(padded)};
  std::fill_n(taps.taps.get(), kh * kw * padded, 0.0f);
  std::fill_n(taps.bias.get(), padded, 0.0f);
  for (Index tap = 0; tap < kh * kw; ++tap) std::copy_n(w + tap * c, c, taps.taps.get() + tap * padded);
  if (bias != nullptr) std::copy_n(bias, c, taps.bias.get());
  return taps;
}

void round_taps(const ByteInput& input, DepthwiseTaps& taps) {
  const Index padded = panels(taps.channels) * kPanel;
  for (Index i = 0; i < taps.count * padded; ++i) taps.taps.get()[i] *= input.factor.get()[i % padded];
  for (Index c = 0; c < padded; ++c)
    taps.bias.get()[c] = taps.bias.get()[c] * input.factor.get()[c] + input.zero.get()[c];
}

void depthwise_rows(const Window& window, const DepthwiseTaps& taps, const float* x, Index begin, Index end, float* y) {
  HWY_DYNAMIC_DISPATCH(depthwise_positions)(window, taps, x, begin, end, y);
}

Index separable_scratch(const Window& window, int threads, Precision precision) {
  const Index block = packed_most_rows(window.c);
  return threads * (block * panels(window.c) * kPanel + packed_scratch(block, window.c, precision));
}

void separable_positions(const Window& window, const float* x, const DepthwiseTaps& depthwise,
                         const PackedWeights& pointwise, PackedFinish finish, Index begin, Index end, float* y,
                         float* scratch) {
  const Index most = packed_most_rows(window.c), blocks = (end - begin + most - 1) / most;
  const Index block = blocks == 0 ? 1 : (end - begin + blocks - 1) / blocks, all = panels(pointwise.n);
  float* rounded = scratch + most * panels(window.c) * kPanel;
  for (; begin < end; begin += block) {
    const Index rows = std::min(block, end - begin);
    if (pointwise.precision == Precision::int8) {
      HWY_DYNAMIC_DISPATCH(depthwise_bytes)(window, depthwise, x, begin, begin + rows, scratch);
      packed_multiply_rounded(rows, {scratch, kPanel / 4, kPanel / 4 * rows, kPanel / 4}, pointwise, 0, all, finish, y);
    } else {
      depthwise_rows(window, depthwise, x, begin, begin + rows, scratch);
      packed_multiply(rows, {scratch, kPanel, kPanel * rows}, pointwise, 0, all, finish, y, rounded);
    }
    if (finish.residual != nullptr) finish.residual += rows * pointwise.n;
    y += rows * pointwise.n;
  }
}

void separable_conv2d(Parallel& parallel, const Window& window, const float* x, const DepthwiseTaps& depthwise,
                      const PackedWeights& pointwise, const PackedFinish& finish, float* y, float* scratch) {
  const Index per_worker = separable_scratch(window, 1, pointwise.precision);
  parallel.for_chunks(window.positions(), packed_block_rows(window.positions(), window.c),
                      [&](Index begin, Index end, int worker) {
                        PackedFinish here = finish;
                        if (here.residual != nullptr) here.residual += begin * pointwise.n;
                        separable_positions(window, x, depthwise, pointwise, here, begin, end, y + begin * pointwise.n,
                                            scratch + worker * per_worker);
                      });
}

}  // namespace svnet::kernels
#endif
