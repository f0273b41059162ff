#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/kernels/pool/inference_pool.cpp"
#include "nn/kernels/pool/inference_pool.h"

#include <algorithm>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// y (C) of the pixels [h0, h1) × [w0, w1) of an image: the largest (NaN wins), or the mean.
template <bool kMax, class D>
HWY_INLINE void pool_channels(D d, const Window& win, const float* image, Index h0, Index h1, Index w0, Index w1,
                              Index c, float* y) {
  auto value = hn::Zero(d);
  for (Index h = h0; h < h1; ++h)
    for (Index w = w0; w < w1; ++w) {
      const auto x = hn::LoadU(d, image + (h * win.w + w) * win.c + c);
      if constexpr (kMax) {
        const auto greater = hn::IfThenElse(hn::Lt(value, x), x, hn::IfThenElse(hn::Eq(x, x), value, x));
        value = h == h0 && w == w0 ? x : greater;
      } else {
        value = hn::Add(value, x);
      }
    }
  const Index count = (h1 - h0) * (w1 - w0);
  if (!kMax && count > 0) value = hn::Div(value, hn::Set(d, static_cast<float>(count)));
  hn::StoreU(value, d, y + c);
}

template <bool kMax>
HWY_INLINE void pool_position(const Window& win, Index p, const float* x, float* y) {
  const hn::ScalableTag<float> d;
  const hn::CappedTag<float, 1> one;
  const Index lanes = static_cast<Index>(hn::Lanes(d));
  const Index ow = p % win.ow, oh = p / win.ow % win.oh, n = p / (win.ow * win.oh);
  const Index h = oh * win.stride_h - win.top, w = ow * win.stride_w - win.left;
  const Index h0 = HWY_MAX(h, Index{0}), h1 = HWY_MAX(h0, HWY_MIN(h + win.kh, win.h));
  const Index w0 = HWY_MAX(w, Index{0}), w1 = HWY_MAX(w0, HWY_MIN(w + win.kw, win.w));
  const float* image = x + n * win.h * win.w * win.c;
  float* to = y + p * win.c;
  Index c = 0;
  for (; c + lanes <= win.c; c += lanes) pool_channels<kMax>(d, win, image, h0, h1, w0, w1, c, to);
  for (; c < win.c; ++c) pool_channels<kMax>(one, win, image, h0, h1, w0, w1, c, to);
}

void max_pool_position(const Window& win, Index p, const float* x, float* y) { pool_position<true>(win, p, x, y); }
void average_pool_position(const Window& win, Index p, const float* x, float* y) { pool_position<false>(win, p, x, y); }

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::kernels {

HWY_EXPORT(max_pool_position);
HWY_EXPORT(average_pool_position);

void max_pool_positions(const Window& win, Index begin, Index end, const float* x, float* y) {
  for (Index p = begin; p < end; ++p) HWY_DYNAMIC_DISPATCH(max_pool_position)(win, p, x, y);
}

void max_pool_inference(Parallel& parallel, const Window& win, const float* x, float* y) {
  parallel.for_chunks(win.positions(), 64,
                      [&](Index begin, Index end, int) { max_pool_positions(win, begin, end, x, y); });
}

void average_pool_inference(Parallel& parallel, const Window& win, const float* x, float* y) {
  parallel.for_chunks(win.positions(), 64, [&](Index begin, Index end, int) {
    for (Index p = begin; p < end; ++p) HWY_DYNAMIC_DISPATCH(average_pool_position)(win, p, x, y);
  });
}

}  // namespace svnet::kernels
#endif
