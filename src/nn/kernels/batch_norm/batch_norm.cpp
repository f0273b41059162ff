#include "nn/kernels/batch_norm/batch_norm.h"

#include <algorithm>
#include <vector>

namespace svnet::kernels {
namespace {

/// sums (C) = Σ term(row offset + c, c) in double, over fixed runs of rows whose partial sums are added in order.
template <class Term>
std::vector<double> row_sums(Parallel& parallel, const RowsShape& s, Term&& term) {
  const Index run = std::max<Index>(32, (s.rows + 63) / 64), runs = (s.rows + run - 1) / run;
  std::vector<double> partial(static_cast<std::size_t>(runs * s.channels), 0.0);
  parallel.for_chunks(s.rows, run, [&](Index begin, Index end, int) {
    double* sum = partial.data() + begin / run * s.channels;
    for (Index row = begin; row < end; ++row)
      for (Index c = 0; c < s.channels; ++c) sum[c] += term(row * s.channels + c, c);
  });
  std::vector<double> sums(static_cast<std::size_t>(s.channels), 0.0);
  for (std::size_t i = 0; i < partial.size(); ++i) sums[i % sums.size()] += partial[i];
  return sums;
}

}  // namespace

template <class T>
void moments(Parallel& parallel, const RowsShape& s, const T* x, T* mean, T* variance) {
  const auto count = static_cast<double>(s.rows);
  std::vector<double> centre = row_sums(parallel, s, [&](Index i, Index) { return static_cast<double>(x[i]); });
  for (double& m : centre) m /= count;
  const auto squares = row_sums(parallel, s, [&](Index i, Index c) {
    const double d = static_cast<double>(x[i]) - centre[static_cast<std::size_t>(c)];
    return d * d;
  });
  for (Index c = 0; c < s.channels; ++c) {
    mean[c] = static_cast<T>(centre[static_cast<std::size_t>(c)]);
    variance[c] = static_cast<T>(squares[static_cast<std::size_t>(c)] / count);
  }
}

template <class T>
void column_sums(Parallel& parallel, const RowsShape& s, const T* a, const T* b, T* sums) {
  const auto total = b == nullptr
                         ? row_sums(parallel, s, [&](Index i, Index) { return static_cast<double>(a[i]); })
                         : row_sums(parallel, s, [&](Index i, Index) { return static_cast<double>(a[i]) * b[i]; });
  for (Index c = 0; c < s.channels; ++c) sums[c] = static_cast<T>(total[static_cast<std::size_t>(c)]);
}

template <class T>
void scale_shift_reference(Parallel& parallel, const RowsShape& s, const T* x, const T* scale, const T* shift,
                           Clamp clamp, T* y) {
  const auto range = range_of<T>(clamp);
  parallel.for_chunks(s.rows, 64, [&](Index begin, Index end, int) {
    for (Index row = begin; row < end; ++row)
      for (Index c = 0; c < s.channels; ++c) {
        const Index i = row * s.channels + c;
        y[i] = range.clamped(x[i] * scale[c] + shift[c]);
      }
  });
}

#define SVNET_INSTANTIATE(T)                                                         \
  template void moments<T>(Parallel&, const RowsShape&, const T*, T*, T*);           \
  template void column_sums<T>(Parallel&, const RowsShape&, const T*, const T*, T*); \
  template void scale_shift_reference<T>(Parallel&, const RowsShape&, const T*, const T*, const T*, Clamp, T*);
SVNET_INSTANTIATE(float)
SVNET_INSTANTIATE(double)
#undef SVNET_INSTANTIATE

}  // namespace svnet::kernels
