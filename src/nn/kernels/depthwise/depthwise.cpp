// Depthwise convolution with multiplier 1, vectorised over channels: for each run of channels the window's products are
// summed in a register.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/kernels/depthwise/depthwise.cpp"
#include "nn/kernels/depthwise/depthwise.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// One output pixel from the taps [kh0, kh1) × [kw0, kw1). x points at the pixel of tap (0, 0), which may lie outside
/// the image.
void depthwise_pixel(const Window& win, Index kh0, Index kh1, Index kw0, Index kw1, const float* x, const float* w,
                     float* y) {
  const hn::ScalableTag<float> d;
  const Index lanes = static_cast<Index>(hn::Lanes(d));
  Index c = 0;
  for (; c + 2 * lanes <= win.c; c += 2 * lanes) {
    auto sum0 = hn::Zero(d), sum1 = hn::Zero(d);
    for (Index kh = kh0; kh < kh1; ++kh)
      for (Index kw = kw0; kw < kw1; ++kw) {
        const float* from = x + (kh * win.w + kw) * win.c + c;
        const float* weight = w + (kh * win.kw + kw) * win.c + c;
        sum0 = hn::MulAdd(hn::LoadU(d, from), hn::LoadU(d, weight), sum0);
        sum1 = hn::MulAdd(hn::LoadU(d, from + lanes), hn::LoadU(d, weight + lanes), sum1);
      }
    hn::StoreU(sum0, d, y + c);
    hn::StoreU(sum1, d, y + c + lanes);
  }
  for (; c + lanes <= win.c; c += lanes) {
    auto sum = hn::Zero(d);
    for (Index kh = kh0; kh < kh1; ++kh)
      for (Index kw = kw0; kw < kw1; ++kw)
        sum = hn::MulAdd(hn::LoadU(d, x + (kh * win.w + kw) * win.c + c),
                         hn::LoadU(d, w + (kh * win.kw + kw) * win.c + c), sum);
    hn::StoreU(sum, d, y + c);
  }
  for (; c < win.c; ++c) {
    float sum = 0;
    for (Index kh = kh0; kh < kh1; ++kh)
      for (Index kw = kw0; kw < kw1; ++kw) sum += x[(kh * win.w + kw) * win.c + c] * w[(kh * win.kw + kw) * win.c + c];
    y[c] = sum;
  }
}

/// Output row n · OH + oh.
void depthwise_row(const Window& win, Index row, const float* x, const float* w, float* y) {
  const Index n = row / win.oh, h = row % win.oh * win.stride_h - win.top;
  const Index kh0 = HWY_MAX(Index{0}, -h), kh1 = HWY_MIN(win.kh, win.h - h);
  for (Index ow = 0; ow < win.ow; ++ow) {
    const Index column = ow * win.stride_w - win.left;
    const Index kw0 = HWY_MAX(Index{0}, -column), kw1 = HWY_MIN(win.kw, win.w - column);
    depthwise_pixel(win, kh0, kh1, kw0, kw1, x + ((n * win.h + h) * win.w + column) * win.c, w,
                    y + (row * win.ow + ow) * win.c);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::kernels {

HWY_EXPORT(depthwise_row);

void depthwise(Parallel& parallel, const DepthwiseShape& s, const float* x, const float* w, float* y,
               const Epilogue<float>& epilogue) {
  if (s.multiplier != 1) return depthwise_reference(parallel, s, x, w, y, epilogue);
  const Index row_size = s.window.ow * s.window.c;
  parallel.for_chunks(s.window.n * s.window.oh, 4, [&](Index begin, Index end, int) {
    for (Index row = begin; row < end; ++row) {
      HWY_DYNAMIC_DISPATCH(depthwise_row)(s.window, row, x, w, y);
      apply(epilogue, s.window.ow, s.window.c, s.window.c, y + row * row_size);
    }
  });
}

}  // namespace svnet::kernels
#endif
