#include "semantics/distances.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "base/error.h"
#include "base/finite.h"
#include "semantics/product_tile.h"

namespace svnet::semantics {
namespace {

constexpr Index kTile = kProductTile, kDepth = kProductDepth;
/// Below this part of |x|² + |y|², |x|² + |y|² - 2 xy keeps fewer digits than a float32 needs.
constexpr double kNearlyEqual = 1e-6;
/// Leaves room in a float32 for the sums of many distances.
constexpr double kLargest = 1e30;
/// Of the squared distances from the mean: leaves room for what is 10^8 times smaller.
constexpr double kSmallestSpread = 1e-30;

template <class T>
void check_finite(const T* features, Index n, Index dimension, Parallel& parallel) {
  parallel.for_chunks(n, 64, [&](Index begin, Index end, int) {
    const std::span rows(features + begin * dimension, static_cast<std::size_t>((end - begin) * dimension));
    if (const auto bad = first_not_finite(rows)) {
      const Index at = static_cast<Index>(*bad);
      fail("[distances] feature ", at % dimension, " of row ", begin + at / dimension, " is ", rows[*bad],
           "; every feature must be finite");
    }
  });
}

template <class T>
std::vector<double> column_means(const T* features, Index n, Index dimension, Parallel& parallel) {
  std::vector<double> mean(dimension, 0.0);
  parallel.for_chunks(dimension, 64, [&](Index begin, Index end, int) {
    for (Index i = 0; i < n; ++i)
      for (Index d = begin; d < end; ++d) mean[d] += features[i * dimension + d];
    for (Index d = begin; d < end; ++d) mean[d] /= n;
  });
  return mean;
}

template <class T>
double direct_distance(const T* x, const T* y, Index dimension) {
  double sum = 0;
  for (Index d = 0; d < dimension; ++d) {
    const double difference = static_cast<double>(x[d]) - y[d];
    sum += difference * difference;
  }
  return sum;
}

/// The input of the tiles.
template <class T>
struct CentredFeatures {
  const T* features;
  Index n, dimension;
  std::vector<double> mean, squared_norm;

  /// Copies features [first_feature, first_feature + depth) of the kTile rows from first_row on, centred, into panels
  /// of `width` rows, the layout of add_products. Rows after the last one are 0.
  void pack(Index first_row, Index first_feature, Index depth, Index width, double* to) const {
    for (Index panel = 0; panel < kTile; panel += width, to += width * depth)
      for (Index r = 0; r < width; ++r) {
        const Index row = first_row + panel + r;
        if (row < n)
          for (Index d = 0; d < depth; ++d)
            to[d * width + r] = features[row * dimension + first_feature + d] - mean[first_feature + d];
        else
          for (Index d = 0; d < depth; ++d) to[d * width + r] = 0;
      }
  }
};

struct TileScratch {
  AlignedArray<double> left{kTile * kDepth}, right{kTile * kDepth}, products{kTile * kTile};
};

template <class T>
void distance_tile(const CentredFeatures<T>& x, Index i0, Index j0, TileScratch& scratch, DistanceMatrix& distances) {
  const auto [left_width, right_width] = panel_widths();
  std::fill_n(scratch.products.data(), kTile * kTile, 0.0);
  for (Index d = 0; d < x.dimension; d += kDepth) {
    const Index depth = std::min(kDepth, x.dimension - d);
    x.pack(i0, d, depth, left_width, scratch.left.data());
    x.pack(j0, d, depth, right_width, scratch.right.data());
    add_products(scratch.left.data(), scratch.right.data(), depth, scratch.products.data());
  }
  const Index i1 = std::min(i0 + kTile, x.n), j1 = std::min(j0 + kTile, x.n);
  for (Index i = i0; i < i1; ++i) {
    float* row = distances.row(i);
    const double* products = scratch.products.data() + (i - i0) * kTile;
    for (Index j = std::max(j0, i + 1); j < j1; ++j) {
      const double norms = x.squared_norm[i] + x.squared_norm[j];
      double distance = norms - 2 * products[j - j0];
      if (distance < kNearlyEqual * norms)
        distance = direct_distance(x.features + i * x.dimension, x.features + j * x.dimension, x.dimension);
      check(distance <= kLargest, "[distances] the squared distance of rows ", i, " and ", j, " is ", distance,
            ", beyond ", kLargest, "; scale the features down");
      row[j] = static_cast<float>(distance);
    }
  }
  // Mirror the tile below the diagonal.
  for (Index i = i0; i < i1; i += 16)
    for (Index j = j0; j < j1; ++j)
      for (Index row = i; row < std::min({i + 16, i1, j}); ++row) distances.row(j)[row] = distances.row(row)[j];
}

template <class T>
bool all_rows_equal(const T* features, Index n, Index dimension) {
  for (Index i = 1; i < n; ++i)
    if (!std::equal(features, features + dimension, features + i * dimension)) return false;
  return true;
}

}  // namespace

DistanceMatrix::DistanceMatrix(Index n)
    : size_(n), stride_((n + 15) / 16 * 16), values_((check(n >= 0, "[distances] ", n, " rows"), n * stride_)) {}

template <class T>
DistanceMatrix squared_distances(const T* features, Index n, Index dimension, Parallel& parallel,
                                 Communicator& communicator) {
  check(n >= 1 && dimension >= 1, "[distances] features are ", n, "x", dimension, "; at least 1x1 is needed");
  check_finite(features, n, dimension, parallel);
  CentredFeatures<T> x{features, n, dimension, column_means(features, n, dimension, parallel), std::vector<double>(n)};
  parallel.for_chunks(n, 64, [&](Index begin, Index end, int) {
    for (Index i = begin; i < end; ++i)
      for (Index d = 0; d < dimension; ++d) {
        const double centred = features[i * dimension + d] - x.mean[d];
        x.squared_norm[i] += centred * centred;
      }
  });
  // Equal rows may differ from their mean by a rounding error.
  const double spread = *std::max_element(x.squared_norm.begin(), x.squared_norm.end());
  check(spread >= kSmallestSpread || all_rows_equal(features, n, dimension), "[distances] no row is farther than ",
        std::sqrt(spread), " from the mean, too little for float32; scale the features up");

  DistanceMatrix distances(n);
  struct Tile {
    Index i, j;
  };
  std::vector<Tile> tiles;
  for (Index i = 0; i < n; i += kTile)
    for (Index j = i; j < n; j += kTile) tiles.push_back({i, j});
  std::vector<TileScratch> scratch(parallel.threads());
  const Share share = share_of(communicator, 0, tiles.size());
  parallel.for_chunks(share.last - share.first, 1, [&](Index begin, Index, int worker) {
    const Tile& tile = tiles[share.first + begin];
    distance_tile(x, tile.i, tile.j, scratch[worker], distances);
  });
  communicator.all_reduce(distances.values());
  return distances;
}

template DistanceMatrix squared_distances(const float*, Index, Index, Parallel&, Communicator&);
template DistanceMatrix squared_distances(const double*, Index, Index, Parallel&, Communicator&);

}  // namespace svnet::semantics
