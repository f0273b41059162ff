// Products of an array with another of its shape, or with one factor per sample and channel (squeeze-and-excitation).
#pragma once
#include <algorithm>
#include <vector>

#include "base/parallel.h"

namespace svnet::kernels {

/// x (N, P, C) with P positions of a sample; the factor is (N, P, C), or (N, C) if it is per channel.
struct MultiplyShape {
  Index n, positions, channels;
  bool per_channel;

  Index sample() const { return positions * channels; }
};

/// y (N, P, C) = x · factor; y may be x.
template <class T>
void multiply(Parallel& parallel, const MultiplyShape& s, const T* x, const T* factor, T* y) {
  parallel.for_chunks(s.n * s.positions, std::max<Index>(1, 16384 / std::max<Index>(s.channels, 1)),
                      [&](Index begin, Index end, int) {
                        for (Index row = begin; row < end; ++row) {
                          const Index factor_row = s.per_channel ? row / s.positions : row;
                          const T *from = x + row * s.channels, *f = factor + factor_row * s.channels;
                          T* to = y + row * s.channels;
                          for (Index c = 0; c < s.channels; ++c) to[c] = from[c] * f[c];
                        }
                      });
}

/// gradient (N, C) of a factor per channel: Σ over the positions of dy · x, in double.
template <class T>
void multiply_channel_gradient(Parallel& parallel, const MultiplyShape& s, const T* x, const T* dy, T* gradient) {
  parallel.for_chunks(s.n, 1, [&](Index sample, Index, int) {
    std::vector<double> sums(static_cast<std::size_t>(s.channels), 0.0);
    const T *a = x + sample * s.sample(), *b = dy + sample * s.sample();
    for (Index i = 0; i < s.sample(); i += s.channels)
      for (Index c = 0; c < s.channels; ++c)
        sums[static_cast<std::size_t>(c)] += static_cast<double>(a[i + c]) * b[i + c];
    std::transform(sums.begin(), sums.end(), gradient + sample * s.channels,
                   [](double v) { return static_cast<T>(v); });
  });
}

}  // namespace svnet::kernels
