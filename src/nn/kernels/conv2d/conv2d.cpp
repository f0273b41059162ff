#include "nn/kernels/conv2d/conv2d.h"

#include <algorithm>
#include <vector>

#include "nn/kernels/gemm.h"

namespace svnet::kernels {
namespace {

/// Output positions per tile: its windows take about 512 KiB and are still in L2 when they are read.
Index tile_positions(const Conv2dShape& s) {
  const Index row = s.window.kh * s.window.kw * s.window.c;
  return std::clamp<Index>((128 * 1024) / std::max<Index>(row, 1), 16, 512);
}

/// Calls body(kh, kw, source) for each window position of output `position`; source is the offset of the pixel's
/// channels in x, or -1 in the border.
template <class Body>
void for_window(const Window& w, Index position, Body&& body) {
  const Index ow = position % w.ow, oh = position / w.ow % w.oh, n = position / (w.ow * w.oh);
  for (Index kh = 0; kh < w.kh; ++kh)
    for (Index kw = 0; kw < w.kw; ++kw) {
      const Index row = oh * w.stride_h - w.top + kh, column = ow * w.stride_w - w.left + kw;
      const bool inside = row >= 0 && row < w.h && column >= 0 && column < w.w;
      body(kh, kw, inside ? ((n * w.h + row) * w.w + column) * w.c : Index{-1});
    }
}

template <class T>
void copy_or_zero(const T* x, Index source, Index count, T* to) {
  if (source < 0)
    std::fill_n(to, count, T{0});
  else
    std::copy_n(x + source, count, to);
}

}  // namespace

template <class T>
void conv2d(Parallel& parallel, const Conv2dShape& s, const T* x, const T* w, T* y) {
  const Window& win = s.window;
  const Index depth = win.kh * win.kw * win.c;
  if (win.reads_in_place()) return gemm(parallel, {.m = win.positions(), .n = s.k, .k = depth}, x, w, y);
  const Index tile = tile_positions(s);
  std::vector<std::vector<T>> scratch(static_cast<std::size_t>(parallel.threads()));
  parallel.for_chunks(win.positions(), tile, [&](Index begin, Index end, int worker) {
    auto& windows = scratch[static_cast<std::size_t>(worker)];
    windows.resize(static_cast<std::size_t>(tile * depth));
    for (Index p = begin; p < end; ++p) {
      T* to = windows.data() + (p - begin) * depth;
      for_window(win, p, [&](Index kh, Index kw, Index source) {
        copy_or_zero(x, source, win.c, to + (kh * win.kw + kw) * win.c);
      });
    }
    gemm_serial({.m = end - begin, .n = s.k, .k = depth}, windows.data(), w, y + begin * s.k);
  });
}

template <class T>
void conv2d_input_gradient(Parallel& parallel, const Conv2dShape& s, const T* dy, const T* w, T* dx) {
  const Window& win = s.window;
  const Index depth = win.kh * win.kw * win.c;
  if (win.reads_in_place())
    return gemm(parallel, {.m = win.positions(), .n = depth, .k = s.k, .transpose_b = true}, dy, w, dx);
  // Windows of one image overlap; images do not.
  const Index per_image = win.oh * win.ow, tile = tile_positions(s);
  parallel.for_chunks(win.n, 1, [&](Index image, Index, int) {
    std::vector<T> windows(static_cast<std::size_t>(tile * depth));
    std::fill_n(dx + image * win.h * win.w * win.c, win.h * win.w * win.c, T{0});
    for (Index begin = 0; begin < per_image; begin += tile) {
      const Index count = std::min(tile, per_image - begin), first = image * per_image + begin;
      gemm_serial({.m = count, .n = depth, .k = s.k, .transpose_b = true}, dy + first * s.k, w, windows.data());
      for (Index p = 0; p < count; ++p)
        for_window(win, first + p, [&](Index kh, Index kw, Index source) {
          if (source < 0) return;
          const T* from = windows.data() + p * depth + (kh * win.kw + kw) * win.c;
          for (Index c = 0; c < win.c; ++c) dx[source + c] += from[c];
        });
    }
  });
}

template <class T>
void conv2d_weight_gradient(Parallel& parallel, const Conv2dShape& s, const T* x, const T* dy, T* dw) {
  const Window& win = s.window;
  if (win.reads_in_place())
    return gemm(parallel, {.m = win.c, .n = s.k, .k = win.positions(), .transpose_a = true}, x, dy, dw);
  const Index tile = std::clamp<Index>((128 * 1024) / std::max<Index>(win.c, 1), 16, 1024);
  parallel.for_chunks(win.kh * win.kw, 1, [&](Index tap, Index, int) {
    std::vector<T> pixels(static_cast<std::size_t>(tile * win.c));
    T* to = dw + tap * win.c * s.k;
    if (win.positions() == 0) std::fill_n(to, win.c * s.k, T{0});
    for (Index begin = 0; begin < win.positions(); begin += tile) {
      const Index count = std::min(tile, win.positions() - begin);
      Window one = win;  // the same stride, this tap alone
      one.kh = one.kw = 1;
      one.top -= tap / win.kw;
      one.left -= tap % win.kw;
      for (Index p = 0; p < count; ++p)
        for_window(one, begin + p,
                   [&](Index, Index, Index source) { copy_or_zero(x, source, win.c, pixels.data() + p * win.c); });
      gemm_serial({.m = win.c, .n = s.k, .k = count, .transpose_a = true, .accumulate = begin > 0}, pixels.data(),
                  dy + begin * s.k, to);
    }
  });
}

template <class T>
void conv2d_reference(const Conv2dShape& s, const T* x, const T* w, T* y) {
  const Window& win = s.window;
  for (Index p = 0; p < win.positions(); ++p)
    for (Index k = 0; k < s.k; ++k) {
      T sum{0};
      for_window(win, p, [&](Index kh, Index kw, Index source) {
        for (Index c = 0; source >= 0 && c < win.c; ++c)
          sum += x[source + c] * w[((kh * win.kw + kw) * win.c + c) * s.k + k];
      });
      y[p * s.k + k] = sum;
    }
}

template <class T>
void conv2d_input_gradient_reference(const Conv2dShape& s, const T* dy, const T* w, T* dx) {
  const Window& win = s.window;
  std::fill_n(dx, win.n * win.h * win.w * win.c, T{0});
  for (Index p = 0; p < win.positions(); ++p)
    for_window(win, p, [&](Index kh, Index kw, Index source) {
      for (Index c = 0; source >= 0 && c < win.c; ++c)
        for (Index k = 0; k < s.k; ++k)
          dx[source + c] += dy[p * s.k + k] * w[((kh * win.kw + kw) * win.c + c) * s.k + k];
    });
}

template <class T>
void conv2d_weight_gradient_reference(const Conv2dShape& s, const T* x, const T* dy, T* dw) {
  const Window& win = s.window;
  std::fill_n(dw, win.kh * win.kw * win.c * s.k, T{0});
  for (Index p = 0; p < win.positions(); ++p)
    for_window(win, p, [&](Index kh, Index kw, Index source) {
      for (Index c = 0; source >= 0 && c < win.c; ++c)
        for (Index k = 0; k < s.k; ++k)
          dw[((kh * win.kw + kw) * win.c + c) * s.k + k] += x[source + c] * dy[p * s.k + k];
    });
}

#define SVNET_INSTANTIATE(T)                                                                      \
  template void conv2d<T>(Parallel&, const Conv2dShape&, const T*, const T*, T*);                 \
  template void conv2d_input_gradient<T>(Parallel&, const Conv2dShape&, const T*, const T*, T*);  \
  template void conv2d_weight_gradient<T>(Parallel&, const Conv2dShape&, const T*, const T*, T*); \
  template void conv2d_reference<T>(const Conv2dShape&, const T*, const T*, T*);                  \
  template void conv2d_input_gradient_reference<T>(const Conv2dShape&, const T*, const T*, T*);   \
  template void conv2d_weight_gradient_reference<T>(const Conv2dShape&, const T*, const T*, T*);
SVNET_INSTANTIATE(float)
SVNET_INSTANTIATE(double)
#undef SVNET_INSTANTIATE

}  // namespace svnet::kernels
