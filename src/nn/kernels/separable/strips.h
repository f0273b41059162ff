#pragma once
#include <algorithm>

#include "base/parallel.h"
#include "nn/kernels/packed/panel.h"
#include "nn/kernels/window.h"

namespace svnet::kernels {

/// Rows of the image that the windows of `rows` output rows cover.
inline Index reached_rows(const Window& w, Index rows) { return (rows - 1) * w.stride_h + w.kh; }

/// Floats of memory for the image rows of `rows` output rows: whole lines, and one vector past the end.
inline Index strip_size(const Window& w, Index rows) {
  return (panels(reached_rows(w, rows) * w.w * w.c) + 1) * kPanel;
}

/// Whether strips are faster: the image is too large for L2, and there are enough rows for all threads.
inline bool fits_strips(const Window& w) { return w.h * w.w * w.c >= Index{256} * 1024 && w.oh >= 28; }

/// Moves the window over images that are never in memory as a whole, `rows` output rows at a time.
/// make(n, row0, row1, to, rest) writes the rows [row0, row1) of image n to `to`.
/// use(strip, position, image, rest) reads the rows in `image` through the window `strip`, whose first output position
/// has the index `position` among all positions.
/// Each worker has per_worker floats of scratch memory: the image, then `rest`. Rows that two chunks need are made
/// twice, with the same bits.
template <class Make, class Use>
void over_strips(Parallel& parallel, const Window& w, Index rows, float* scratch, Index per_worker, const Make& make,
                 const Use& use) {
  constexpr Index kChunks = 4;  // of an image
  const Index row_size = w.w * w.c, of_chunk = (w.oh + kChunks - 1) / kChunks;
  parallel.for_chunks(w.n * kChunks, 1, [&](Index chunk, Index, int worker) {
    const Index n = chunk / kChunks, first = chunk % kChunks * of_chunk, last = std::min(w.oh, first + of_chunk);
    float* image = scratch + worker * per_worker;
    float* rest = image + strip_size(w, rows);
    Index kept0 = 0, kept1 = 0;  // the rows [kept0, kept1) of the image are in memory
    for (Index oh = first; oh < last; oh += rows) {
      Window strip = w;
      strip.n = 1;
      strip.oh = std::min(rows, last - oh);
      const Index top = oh * w.stride_h - w.top;
      const Index row0 = std::max<Index>(0, top), row1 = std::min(w.h, top + reached_rows(w, strip.oh));
      const Index made = std::max(row0, kept1);
      if (made > row0) std::copy_n(image + (row0 - kept0) * row_size, (made - row0) * row_size, image);
      if (row1 > made) make(n, made, row1, image + (made - row0) * row_size, rest);
      kept0 = row0;
      kept1 = row1;
      strip.h = row1 - row0;
      strip.top = row0 - top;
      use(strip, (n * w.oh + oh) * w.ow, image, rest);
    }
  });
}

}  // namespace svnet::kernels
