#pragma once
#include <algorithm>

#include "base/parallel.h"
#include "nn/kernels/packed/panel.h"
#include "nn/kernels/window.h"

namespace svnet::kernels {

/// Rows of the image that so many output rows reach.
inline Index reached_rows(const Window& w, Index rows) { return (rows - 1) * w.stride_h + w.kh; }

/// Numbers of an image of so many output rows: whole lines, and one vector past the end.
inline Index strip_room(const Window& w, Index rows) {
  return (panels(reached_rows(w, rows) * w.w * w.c) + 1) * kPanel;
}

/// Whether images are better made strip by strip: where they are too large for L2, and rows suffice for all threads.
inline bool fits_strips(const Window& w) { return w.h * w.w * w.c >= Index{256} * 1024 && w.oh >= 28; }

/// Slides the window over images that nobody holds as a whole: `rows` output rows at a time, for which
/// make(n, row0, row1, to, rest) makes rows [row0, row1) of image n, and use(strip, position, image, rest) takes them:
/// strip is the window over them, whose first position is number `position` of all. Each worker has per_worker numbers
/// of scratch, the image first and then the rest. Rows that the strips of two chunks reach are made twice: whoever
/// makes them gives the same bits.
template <class Make, class Use>
void over_strips(Parallel& parallel, const Window& w, Index rows, float* scratch, Index per_worker, const Make& make,
                 const Use& use) {
  constexpr Index kChunks = 4;  // of an image
  const Index row_size = w.w * w.c, of_chunk = (w.oh + kChunks - 1) / kChunks;
  parallel.for_chunks(w.n * kChunks, 1, [&](Index chunk, Index, int worker) {
    const Index n = chunk / kChunks, first = chunk % kChunks * of_chunk, last = std::min(w.oh, first + of_chunk);
    float* image = scratch + worker * per_worker;
    float* rest = image + strip_room(w, rows);
    Index have0 = 0, have1 = 0;  // rows of the image that lie in memory
    for (Index oh = first; oh < last; oh += rows) {
      Window strip = w;
      strip.n = 1;
      strip.oh = std::min(rows, last - oh);
      const Index top = oh * w.stride_h - w.top;
      const Index row0 = std::max<Index>(0, top), row1 = std::min(w.h, top + reached_rows(w, strip.oh));
      const Index made = std::max(row0, have1);
      if (made > row0) std::copy_n(image + (row0 - have0) * row_size, (made - row0) * row_size, image);
      if (row1 > made) make(n, made, row1, image + (made - row0) * row_size, rest);
      have0 = row0;
      have1 = row1;
      strip.h = row1 - row0;
      strip.top = row0 - top;
      use(strip, (n * w.oh + oh) * w.ow, image, rest);
    }
  });
}

}  // namespace svnet::kernels
