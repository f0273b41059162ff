#include "semantics/distances.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include <sys/mman.h>

#include "base/error.h"

namespace svnet {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr Index kTile = 128;   // rows and columns of one parallel task
constexpr Index kDepth = 256;  // features multiplied at once: two panels of kTile x kDepth doubles stay in L2
/// Below this part of |x|² + |y|², |x|² + |y|² - 2 xy keeps fewer digits than a float32 needs.
constexpr double kNearlyEqual = 1e-6;

template <class T>
void check_finite(const T* features, Index n, Index dimension, Parallel& parallel) {
  parallel.for_chunks(n, 64, [&](Index begin, Index end, int) {
    for (Index i = begin; i < end; ++i)
      for (Index d = 0; d < dimension; ++d)
        check(std::isfinite(features[i * dimension + d]), "[distances] feature ", d, " of row ", i, " is ",
              features[i * dimension + d], "; every feature must be finite");
  });
}

template <class T>
std::vector<double> column_means(const T* features, Index n, Index dimension, Parallel& parallel) {
  std::vector<double> mean(dimension, 0.0);
  parallel.for_chunks(dimension, 64, [&](Index begin, Index end, int) {
    for (Index i = 0; i < n; ++i)
      for (Index d = begin; d < end; ++d) mean[d] += features[i * dimension + d];
    for (Index d = begin; d < end; ++d) mean[d] /= static_cast<double>(n);
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

/// What the tiles read.
template <class T>
struct CentredFeatures {
  const T* features;
  Index n, dimension;
  std::vector<double> mean, squared_norm;

  /// Features [first_feature, first_feature + columns) of rows [first_row, first_row + rows), centred.
  void panel(Index first_row, Index rows, Index first_feature, Index columns, Matrix& out) const {
    for (Index r = 0; r < rows; ++r) {
      const T* x = features + (first_row + r) * dimension + first_feature;
      double* y = out.row(r).data();
      for (Index d = 0; d < columns; ++d) y[d] = x[d] - mean[first_feature + d];
    }
  }
};

struct TileScratch {
  Matrix left{kTile, kDepth}, right{kTile, kDepth}, products{kTile, kTile};
};

template <class T>
void distance_tile(const CentredFeatures<T>& x, Index i0, Index j0, TileScratch& scratch, DistanceMatrix& distances) {
  const Index rows = std::min(kTile, x.n - i0), columns = std::min(kTile, x.n - j0);
  scratch.products.setZero();
  for (Index d = 0; d < x.dimension; d += kDepth) {
    const Index depth = std::min(kDepth, x.dimension - d);
    x.panel(i0, rows, d, depth, scratch.left);
    x.panel(j0, columns, d, depth, scratch.right);
    scratch.products.topLeftCorner(rows, columns).noalias() +=
        scratch.left.topLeftCorner(rows, depth) * scratch.right.topLeftCorner(columns, depth).transpose();
  }
  for (Index i = i0; i < i0 + rows; ++i)
    for (Index j = std::max(j0, i + 1); j < j0 + columns; ++j) {
      const double norms = x.squared_norm[i] + x.squared_norm[j];
      double distance = norms - 2 * scratch.products(i - i0, j - j0);
      if (distance < kNearlyEqual * norms)
        distance = direct_distance(x.features + i * x.dimension, x.features + j * x.dimension, x.dimension);
      check(distance <= std::numeric_limits<float>::max(), "[distances] the squared distance of rows ", i, " and ", j,
            " is ", distance, ", beyond float32; scale the features down");
      distances.row(i)[j] = distances.row(j)[i] = static_cast<float>(distance);
    }
}

}  // namespace

DistanceMatrix::DistanceMatrix(Index n)
    : size_(n),
      stride_((n + 15) / 16 * 16),
      values_((check(n >= 0, "[distances] ", n, " rows"), static_cast<std::size_t>(n * stride_))) {}

template <class T>
DistanceMatrix squared_distances(const T* features, Index n, Index dimension, Parallel& parallel) {
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

  DistanceMatrix distances(n);
  struct Tile {
    Index i, j;
  };
  std::vector<Tile> tiles;
  for (Index i = 0; i < n; i += kTile)
    for (Index j = i; j < n; j += kTile) tiles.push_back({i, j});
  std::vector<TileScratch> scratch(parallel.threads());
  parallel.for_chunks(static_cast<Index>(tiles.size()), 1, [&](Index begin, Index, int worker) {
    distance_tile(x, tiles[begin].i, tiles[begin].j, scratch[worker], distances);
  });
  return distances;
}

template DistanceMatrix squared_distances(const float*, Index, Index, Parallel&);
template DistanceMatrix squared_distances(const double*, Index, Index, Parallel&);

}  // namespace svnet
