#include "nn/kernels/depthwise/depthwise.h"

namespace svnet::kernels {
namespace {

/// Calls body(x offset, y offset, w offset) for every window position that meets the image, for output row
/// `row` of all images (n · OH + oh). Offsets are of channel 0.
template <class Body>
void for_taps(const DepthwiseShape& s, Index row, Body&& body) {
  const Window& win = s.window;
  const Index n = row / win.oh, oh = row % win.oh;
  for (Index ow = 0; ow < win.ow; ++ow)
    for (Index kh = 0; kh < win.kh; ++kh) {
      const Index h = oh * win.stride_h - win.top + kh;
      if (h < 0 || h >= win.h) continue;
      for (Index kw = 0; kw < win.kw; ++kw) {
        const Index w = ow * win.stride_w - win.left + kw;
        if (w < 0 || w >= win.w) continue;
        body(((n * win.h + h) * win.w + w) * win.c, (row * win.ow + ow) * win.c * s.multiplier,
             (kh * win.kw + kw) * win.c * s.multiplier);
      }
    }
}

}  // namespace

template <class T>
void depthwise_reference(Parallel& parallel, const DepthwiseShape& s, const T* x, const T* w, T* y,
                         const Epilogue<T>& epilogue) {
  const Window& win = s.window;
  const Index row_size = win.ow * win.c * s.multiplier;
  parallel.for_chunks(win.n * win.oh, 1, [&](Index row, Index, int) {
    std::fill_n(y + row * row_size, row_size, T{0});
    for_taps(s, row, [&](Index at_x, Index at_y, Index at_w) {
      for (Index c = 0; c < win.c; ++c)
        for (Index m = 0; m < s.multiplier; ++m)
          y[at_y + c * s.multiplier + m] += x[at_x + c] * w[at_w + c * s.multiplier + m];
    });
    apply(epilogue, win.ow, win.c * s.multiplier, win.c * s.multiplier, y + row * row_size);
  });
}

template <class T>
void depthwise_input_gradient_reference(Parallel& parallel, const DepthwiseShape& s, const T* dy, const T* w, T* dx) {
  const Window& win = s.window;
  parallel.for_chunks(win.n, 1, [&](Index image, Index, int) {
    std::fill_n(dx + image * win.h * win.w * win.c, win.h * win.w * win.c, T{0});
    for (Index row = image * win.oh; row < (image + 1) * win.oh; ++row)
      for_taps(s, row, [&](Index at_x, Index at_y, Index at_w) {
        for (Index c = 0; c < win.c; ++c)
          for (Index m = 0; m < s.multiplier; ++m)
            dx[at_x + c] += dy[at_y + c * s.multiplier + m] * w[at_w + c * s.multiplier + m];
      });
  });
}

template <class T>
void depthwise_weight_gradient_reference(Parallel& parallel, const DepthwiseShape& s, const T* x, const T* dy, T* dw) {
  sum_over_rows(parallel, s, dw, [&](Index row, T* sum) {
    for_taps(s, row, [&](Index at_x, Index at_y, Index at_w) {
      for (Index c = 0; c < s.window.c; ++c)
        for (Index m = 0; m < s.multiplier; ++m)
          sum[at_w + c * s.multiplier + m] += x[at_x + c] * dy[at_y + c * s.multiplier + m];
    });
  });
}

#define SVNET_INSTANTIATE(T)                                                                                          \
  template void depthwise_reference<T>(Parallel&, const DepthwiseShape&, const T*, const T*, T*, const Epilogue<T>&); \
  template void depthwise_input_gradient_reference<T>(Parallel&, const DepthwiseShape&, const T*, const T*, T*);      \
  template void depthwise_weight_gradient_reference<T>(Parallel&, const DepthwiseShape&, const T*, const T*, T*);
SVNET_INSTANTIATE(float)
SVNET_INSTANTIATE(double)
#undef SVNET_INSTANTIATE

}  // namespace svnet::kernels
