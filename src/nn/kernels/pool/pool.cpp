#include "nn/kernels/pool/pool.h"

#include <algorithm>
#include <limits>

namespace svnet::kernels {
namespace {

/// Channels that are compared at once.
constexpr Index kChannels = 32;

/// The part of the window of output position p that is inside the image.
struct Inside {
  Index n, h0, h1, w0, w1;
  Index count() const { return std::max<Index>(h1 - h0, 0) * std::max<Index>(w1 - w0, 0); }
};

Inside inside(const Window& win, Index p) {
  const Index ow = p % win.ow, oh = p / win.ow % win.oh;
  const Index h = oh * win.stride_h - win.top, w = ow * win.stride_w - win.left;
  return {p / (win.ow * win.oh), std::max<Index>(h, 0), std::min(h + win.kh, win.h), std::max<Index>(w, 0),
          std::min(w + win.kw, win.w)};
}

/// Calls body(offset of the pixel's channel 0 in x).
template <class Body>
void for_pixels(const Window& win, const Inside& part, Body&& body) {
  for (Index h = part.h0; h < part.h1; ++h)
    for (Index w = part.w0; w < part.w1; ++w) body(((part.n * win.h + h) * win.w + w) * win.c);
}

/// The maximum of a few channels over the pixels of a window, and its position. Without branches, so that the compiler
/// vectorises it.
/// The first among equals; a NaN is larger than any number.
template <class T>
void max_of_channels(const Window& win, const Inside& part, const T* x, Index first, Index count, T* y,
                     std::int64_t* source) {
  T best[kChannels];
  std::int32_t at[kChannels];  // number of the pixel in the part
  std::fill_n(best, count, -std::numeric_limits<T>::infinity());
  std::fill_n(at, count, 0);
  std::int32_t number = 0;
  for_pixels(win, part, [&](Index pixel) {
    const T* values = x + pixel + first;
    for (Index c = 0; c < count; ++c) {
      const bool larger = values[c] > best[c] || values[c] != values[c];
      best[c] = larger ? values[c] : best[c];
      at[c] = larger ? number : at[c];
    }
    ++number;
  });
  const Index width = part.w1 - part.w0, corner = ((part.n * win.h + part.h0) * win.w + part.w0) * win.c + first;
  for (Index c = 0; c < count; ++c) {
    y[c] = best[c];
    source[c] = corner + (at[c] / width * win.w + at[c] % width) * win.c + c;
  }
}

}  // namespace

template <class T>
void max_pool(Parallel& parallel, const Window& win, const T* x, T* y, std::int64_t* source) {
  parallel.for_chunks(win.positions(), 16, [&](Index begin, Index end, int) {
    for (Index p = begin; p < end; ++p) {
      const Inside part = inside(win, p);
      if (part.count() == 0) {
        std::fill_n(y + p * win.c, win.c, T{0});
        std::fill_n(source + p * win.c, win.c, std::int64_t{-1});
        continue;
      }
      for (Index c = 0; c < win.c; c += kChannels)
        max_of_channels(win, part, x, c, std::min(kChannels, win.c - c), y + p * win.c + c, source + p * win.c + c);
    }
  });
}

template <class T>
void max_pool_gradient(Parallel& parallel, const Window& win, const T* dy, const std::int64_t* source, T* dx) {
  const Index image = win.h * win.w * win.c, pooled = win.oh * win.ow * win.c;
  parallel.for_chunks(win.n, 1, [&](Index n, Index, int) {
    std::fill_n(dx + n * image, image, T{0});
    for (Index i = n * pooled; i < (n + 1) * pooled; ++i)
      if (source[i] >= 0) dx[source[i]] += dy[i];
  });
}

template <class T>
void average_pool(Parallel& parallel, const Window& win, const T* x, T* y) {
  parallel.for_chunks(win.positions(), 16, [&](Index begin, Index end, int) {
    for (Index p = begin; p < end; ++p) {
      const Inside part = inside(win, p);
      T* to = y + p * win.c;
      std::fill_n(to, win.c, T{0});
      for_pixels(win, part, [&](Index pixel) {
        for (Index c = 0; c < win.c; ++c) to[c] += x[pixel + c];
      });
      const T count = static_cast<T>(std::max<Index>(part.count(), 1));
      for (Index c = 0; c < win.c; ++c) to[c] /= count;
    }
  });
}

template <class T>
void average_pool_gradient(Parallel& parallel, const Window& win, const T* dy, T* dx) {
  const Index image = win.h * win.w * win.c, per_image = win.oh * win.ow;
  parallel.for_chunks(win.n, 1, [&](Index n, Index, int) {
    std::fill_n(dx + n * image, image, T{0});
    for (Index p = n * per_image; p < (n + 1) * per_image; ++p) {
      const Inside part = inside(win, p);
      const T count = static_cast<T>(std::max<Index>(part.count(), 1));
      for_pixels(win, part, [&](Index pixel) {
        for (Index c = 0; c < win.c; ++c) dx[pixel + c] += dy[p * win.c + c] / count;
      });
    }
  });
}

#define SVNET_INSTANTIATE(T)                                                                       \
  template void max_pool<T>(Parallel&, const Window&, const T*, T*, std::int64_t*);                \
  template void max_pool_gradient<T>(Parallel&, const Window&, const T*, const std::int64_t*, T*); \
  template void average_pool<T>(Parallel&, const Window&, const T*, T*);                           \
  template void average_pool_gradient<T>(Parallel&, const Window&, const T*, T*);
SVNET_INSTANTIATE(float)
SVNET_INSTANTIATE(double)
#undef SVNET_INSTANTIATE

}  // namespace svnet::kernels
