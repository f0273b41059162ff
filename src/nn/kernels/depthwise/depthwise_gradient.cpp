// Gradients of the depthwise convolution with multiplier 1. The input gradient at stride 1 is a convolution of dy with
// the flipped weights. The weight gradient is summed in registers along each output row, a run of channels at a time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/kernels/depthwise/depthwise_gradient.cpp"
#include <algorithm>
#include <vector>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "nn/kernels/depthwise/depthwise.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// sum[c] += Σ x[i · x_step + c] · dy[i · c_all + c] over i in [0, count), for kVectors vectors of channels.
template <int kVectors, class D>
void add_products(D d, Index count, const float* x, Index x_step, const float* dy, Index dy_step, float* sum) {
  const Index lanes = static_cast<Index>(hn::Lanes(d));
  hn::Vec<D> total[kVectors];
  for (int v = 0; v < kVectors; ++v) total[v] = hn::LoadU(d, sum + v * lanes);
  for (Index i = 0; i < count; ++i, x += x_step, dy += dy_step)
    for (int v = 0; v < kVectors; ++v)
      total[v] = hn::MulAdd(hn::LoadU(d, x + v * lanes), hn::LoadU(d, dy + v * lanes), total[v]);
  for (int v = 0; v < kVectors; ++v) hn::StoreU(total[v], d, sum + v * lanes);
}

/// Adds output row n · OH + oh to sum (KH, KW, C).
void add_weight_gradient_of_row(const Window& win, Index row, const float* x, const float* dy, float* sum) {
  constexpr int kVectors = 4;
  const hn::ScalableTag<float> d;
  const hn::CappedTag<float, 1> one;
  const Index lanes = static_cast<Index>(hn::Lanes(d)), x_step = win.stride_w * win.c;
  const Index n = row / win.oh, top = row % win.oh * win.stride_h - win.top;
  for (Index kh = HWY_MAX(Index{0}, -top); kh < HWY_MIN(win.kh, win.h - top); ++kh)
    for (Index kw = 0; kw < win.kw; ++kw) {
      // The output columns [first, last) whose tap is inside the image.
      const Index before = win.left - kw, after = win.w - 1 + before;
      const Index first = before > 0 ? (before + win.stride_w - 1) / win.stride_w : 0;
      const Index last = after < 0 ? 0 : HWY_MIN(win.ow, after / win.stride_w + 1);
      if (first >= last) continue;
      const float* from = x + ((n * win.h + top + kh) * win.w + first * win.stride_w - before) * win.c;
      const float* gradient = dy + (row * win.ow + first) * win.c;
      float* to = sum + (kh * win.kw + kw) * win.c;
      Index c = 0;
      for (; c + kVectors * lanes <= win.c; c += kVectors * lanes)
        add_products<kVectors>(d, last - first, from + c, x_step, gradient + c, win.c, to + c);
      for (; c + lanes <= win.c; c += lanes)
        add_products<1>(d, last - first, from + c, x_step, gradient + c, win.c, to + c);
      for (; c < win.c; ++c) add_products<1>(one, last - first, from + c, x_step, gradient + c, win.c, to + c);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::kernels {

HWY_EXPORT(add_weight_gradient_of_row);

void depthwise_input_gradient(Parallel& parallel, const DepthwiseShape& s, const float* dy, const float* w, float* dx) {
  const Window& win = s.window;
  if (s.multiplier != 1 || win.stride_h != 1 || win.stride_w != 1)
    return depthwise_input_gradient_reference(parallel, s, dy, w, dx);
  const Index taps = win.kh * win.kw;
  std::vector<float> flipped(static_cast<std::size_t>(taps * win.c));
  for (Index tap = 0; tap < taps; ++tap) std::copy_n(w + tap * win.c, win.c, flipped.data() + (taps - 1 - tap) * win.c);
  depthwise(parallel, {win.input_gradient(win.c), 1}, dy, flipped.data(), dx);
}

void depthwise_weight_gradient(Parallel& parallel, const DepthwiseShape& s, const float* x, const float* dy,
                               float* dw) {
  if (s.multiplier != 1) return depthwise_weight_gradient_reference(parallel, s, x, dy, dw);
  const Window& win = s.window;
  sum_over_rows<float>(parallel, s, dw, [&](Index row, float* sum) {
    HWY_DYNAMIC_DISPATCH(add_weight_gradient_of_row)(win, row, x, dy, sum);
  });
}

}  // namespace svnet::kernels
#endif
