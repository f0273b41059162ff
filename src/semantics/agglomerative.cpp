// Greedy agglomeration with cached nearest neighbours, after Müllner, "Modern hierarchical, agglomerative clustering
// algorithms" (arXiv 1109.2378), section 3; updates by Lance and Williams (The Computer Journal 9, 1967).
#include "semantics/agglomerative.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/text.h"

namespace svnet {
namespace {

using Row = Eigen::Map<Eigen::ArrayXd>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::array<std::string_view, 4> kNames{"ward", "average", "complete", "single"};

/// The first position of the smallest of n > 0 values.
Index first_minimum(const double* values, Index n) {
  const double smallest = Eigen::Map<const Eigen::ArrayXd>(values, n).minCoeff();
  Index i = 0;
  while (values[i] != smallest) ++i;
  return i;
}

}  // namespace

std::string_view linkage_name(Linkage linkage) { return kNames[static_cast<std::size_t>(linkage)]; }

Linkage linkage_named(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) {
    const std::vector<std::string> known(kNames.begin(), kNames.end());
    fail("[linkage] '", name, "' is unknown", suggestion(name, known));
  }
  return static_cast<Linkage>(found - kNames.begin());
}

Agglomerative::Agglomerative(Linkage linkage, Index max_points)
    : linkage_(linkage),
      max_points_(max_points),
      dissimilarity_(static_cast<std::size_t>(max_points * (max_points + 1))),
      size_(max_points),
      nearest_dissimilarity_(max_points),
      nearest_(max_points),
      merged_into_(max_points) {}

void Agglomerative::cluster(const DistanceMatrix& distances, std::span<const std::int32_t> rows, Index k,
                            std::span<std::int32_t> labels) {
  n_ = static_cast<Index>(rows.size());
  check(k >= 1 && k <= n_, "[agglomerative] cannot make ", k, " clusters of ", n_, " points; 1 to ", n_,
        " are possible");
  check(n_ <= max_points_, "[agglomerative] ", n_, " points, but memory was made for ", max_points_);
  check(labels.size() == rows.size(), "[agglomerative] ", labels.size(), " labels for ", n_, " points");

  gather(distances, rows);
  for (Index i = 0; i < n_; ++i) {
    size_[i] = 1;
    merged_into_[i] = static_cast<std::int32_t>(i);
    find_nearest(i);
  }
  for (Index clusters = n_; clusters > k; --clusters) {
    const Index a = first_minimum(nearest_dissimilarity_.data(), n_);
    const Index b = nearest_[a];
    merge(a, b);
    update_nearest(a, b);
  }

  std::int32_t next = 0;
  for (Index i = 0; i < n_; ++i) labels[i] = merged_into_[i] == i ? next++ : labels[merged_into_[i]];
}

void Agglomerative::gather(const DistanceMatrix& distances, std::span<const std::int32_t> rows) {
  stride_ = (n_ + 1) / 2 * 2;
  for (Index i = 0; i < n_; ++i) {
    const float* from = distances.row(rows[i]);
    double* to = &dissimilarity_[i * stride_];
    for (Index j = 0; j < i; ++j) to[j] = dissimilarity_[j * stride_ + i] = from[rows[j]];
    to[i] = kInfinity;
  }
  if (linkage_ == Linkage::average)
    for (Index i = 0; i < n_; ++i) Row(&dissimilarity_[i * stride_], n_) = Row(&dissimilarity_[i * stride_], n_).sqrt();
}

void Agglomerative::find_nearest(Index i) {
  if (i + 1 == n_) {
    nearest_[i] = -1;
    nearest_dissimilarity_[i] = kInfinity;
    return;
  }
  const double* row = &dissimilarity_[i * stride_];
  const Index j = i + 1 + first_minimum(row + i + 1, n_ - i - 1);
  nearest_[i] = static_cast<std::int32_t>(j);
  nearest_dissimilarity_[i] = row[j];
}

void Agglomerative::merge(Index a, Index b) {
  Row row_a(&dissimilarity_[a * stride_], n_), row_b(&dissimilarity_[b * stride_], n_), size(size_.data(), n_);
  const double between = row_a[b];
  switch (linkage_) {
    case Linkage::ward:
      row_a = ((size + size_[a]) * row_a + (size + size_[b]) * row_b - size * between) / (size + (size_[a] + size_[b]));
      break;
    case Linkage::average:
      row_a = (size_[a] * row_a + size_[b] * row_b) / (size_[a] + size_[b]);
      break;
    case Linkage::complete:
      row_a = row_a.max(row_b);
      break;
    case Linkage::single:
      row_a = row_a.min(row_b);
      break;
  }
  row_a[a] = row_a[b] = kInfinity;
  for (Index i = 0; i < n_; ++i) {
    dissimilarity_[i * stride_ + a] = row_a[i];
    dissimilarity_[i * stride_ + b] = kInfinity;
  }
  size_[a] += size_[b];
  merged_into_[b] = static_cast<std::int32_t>(a);
}

/// The linkages are reducible: a merged cluster is never nearer to a third than the nearer of its halves was. So only
/// slots whose nearest was a or b need a new search; the others change in ties alone.
void Agglomerative::update_nearest(Index a, Index b) {
  nearest_[b] = -1;
  nearest_dissimilarity_[b] = kInfinity;
  for (Index i = 0; i < a; ++i) {
    const double to_a = dissimilarity_[i * stride_ + a];
    if (nearest_[i] == a || nearest_[i] == b) {
      find_nearest(i);
    } else if (to_a < nearest_dissimilarity_[i] || (to_a == nearest_dissimilarity_[i] && a < nearest_[i])) {
      nearest_[i] = static_cast<std::int32_t>(a);
      nearest_dissimilarity_[i] = to_a;
    }
  }
  for (Index i = a + 1; i < b; ++i)
    if (nearest_[i] == b) find_nearest(i);
  find_nearest(a);
}

}  // namespace svnet
