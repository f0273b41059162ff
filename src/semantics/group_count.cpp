#include "semantics/group_count.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.h"
#include "base/parallel.h"

namespace svnet::semantics {
namespace {

/// A group height is factor * mean^(1 - weight) * top^weight, of the mean distance of two items and the height of the
/// last merge.
struct HeightRule {
  double factor, weight;
};

/// Chosen on the rendered collection, and confirmed on ETH-80 by bench/compare_group_counts.py.
constexpr HeightRule height_rule(Linkage linkage) {
  switch (linkage) {
    case Linkage::ward:
      return {1.02, 0.2};
    case Linkage::average:
      return {0.96, 0};
    case Linkage::complete:
      return {1.02, 0.15};
    case Linkage::single:
      return {0.9, 0.3};
  }
  return {1, 0};
}

/// The sum of distances from each item to each cluster while clusters are merged. A cluster has a column; the columns
/// that are in use come first.
class ClusterSums {
 public:
  explicit ClusterSums(const DistanceMatrix& distances)
      : n_(distances.size()), columns_(n_), sums_(static_cast<std::size_t>(n_ * n_)) {
    for (Index i = 0; i < n_; ++i) {
      size_.push_back(1);
      cluster_of_column_.push_back(i);
      column_of_item_.push_back(i);
      column_of_cluster_.push_back(i);
      for (Index j = 0; j < n_; ++j) sums_of(i)[j] = std::sqrt(static_cast<double>(distances(i, j)));
    }
  }

  void merge(const Merge& merge) {
    const Index a = std::min(column_of(merge.a), column_of(merge.b)),
                b = std::max(column_of(merge.a), column_of(merge.b));
    const Index last = --columns_;
    for (Index i = 0; i < n_; ++i) {
      double* sums = sums_of(i);
      sums[a] += sums[b];
      sums[b] = sums[last];
      Index& column = column_of_item_[static_cast<std::size_t>(i)];
      column = column == b ? a : column == last ? b : column;
    }
    size(a) += size(b);
    size(b) = size(last);
    const Index moved = cluster_of_column_[static_cast<std::size_t>(last)];
    cluster_of_column_[static_cast<std::size_t>(b)] = moved;
    column_of_cluster_[static_cast<std::size_t>(moved)] = b;
    cluster_of_column_[static_cast<std::size_t>(a)] = static_cast<Index>(column_of_cluster_.size());
    column_of_cluster_.push_back(a);
  }

  double mean_silhouette() {
    std::vector<double> inverse, silhouette(static_cast<std::size_t>(n_));
    for (Index c = 0; c < columns_; ++c) inverse.push_back(1 / size(c));
    Parallel::shared().for_chunks(n_, 64, [&](Index begin, Index end, int) {
      for (Index i = begin; i < end; ++i) silhouette[static_cast<std::size_t>(i)] = silhouette_of(i, inverse.data());
    });
    return std::accumulate(silhouette.begin(), silhouette.end(), 0.0) / static_cast<double>(n_);
  }

 private:
  double silhouette_of(Index item, const double* inverse_size) {
    const Index own = column_of_item_[static_cast<std::size_t>(item)];
    const double others = size(own) - 1, *sums = sums_of(item);
    if (others == 0) return 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (Index c = 0; c < own; ++c) nearest = std::min(nearest, sums[c] * inverse_size[c]);
    for (Index c = own + 1; c < columns_; ++c) nearest = std::min(nearest, sums[c] * inverse_size[c]);
    const double within = sums[own] / others, larger = std::max(within, nearest);
    return larger > 0 ? (nearest - within) / larger : 0;
  }

  double* sums_of(Index item) { return sums_.data() + item * n_; }
  double& size(Index column) { return size_[static_cast<std::size_t>(column)]; }
  Index column_of(std::int32_t cluster) const { return column_of_cluster_[static_cast<std::size_t>(cluster)]; }

  Index n_, columns_;
  std::vector<double> sums_, size_{};
  std::vector<Index> cluster_of_column_{}, column_of_item_{}, column_of_cluster_{};
};

Index by_silhouette(const Dendrogram& history, const DistanceMatrix& distances) {
  const std::vector<double> silhouettes = mean_silhouettes(history, distances);
  return std::ranges::max_element(silhouettes) - silhouettes.begin();
}

Index by_gap(const Dendrogram& history) {
  Index best = 2;
  double widest = -1;
  for (Index k = 2; k < history.items; ++k) {
    const auto above = static_cast<std::size_t>(history.items - k);  // the merge from k clusters to k - 1
    const double gap = history.merges[above].height - history.merges[above - 1].height;
    if (gap > widest) {
      widest = gap;
      best = k;
    }
  }
  return best;
}

Index above_height(const Dendrogram& history, double height) {
  return 1 + std::ranges::count_if(history.merges, [height](const Merge& merge) { return merge.height > height; });
}

}  // namespace

GroupCount group_count_named(const std::string& name) {
  const auto found = find_enum<GroupCount>(name);
  check(found.has_value(), "[group_count] '", name, "' is unknown", suggestion(name, names_of<GroupCount>()));
  return *found;
}

Index group_count(GroupCount method, Linkage linkage, const Dendrogram& history, const DistanceMatrix& distances) {
  if (history.items <= 2 || history.merges.back().height == 0)
    return history.items == 1 || history.merges.back().height == 0 ? 1 : 2;
  switch (method) {
    case GroupCount::height:
      return above_height(history, group_height(linkage, history, distances));
    case GroupCount::silhouette:
      return by_silhouette(history, distances);
    case GroupCount::gap:
      return by_gap(history);
  }
  fail("[group_count] no method has this number");
}

double group_height(Linkage linkage, const Dendrogram& history, const DistanceMatrix& distances) {
  const Index n = distances.size();
  if (n < 2) return 0;
  double sum = 0;
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < i; ++j) sum += std::sqrt(static_cast<double>(distances(i, j)));
  const double mean = sum / (static_cast<double>(n) * static_cast<double>(n - 1) / 2);
  const HeightRule rule = height_rule(linkage);
  return rule.factor * std::pow(mean, 1 - rule.weight) * std::pow(history.merges.back().height, rule.weight);
}

std::vector<double> mean_silhouettes(const Dendrogram& history, const DistanceMatrix& distances) {
  const Index n = history.items;
  check(n == distances.size(), "[silhouette] a dendrogram of ", n, " items, distances of ", distances.size());
  std::vector<double> silhouettes(static_cast<std::size_t>(std::max<Index>(n, 2)), -1.0);
  ClusterSums sums(distances);
  for (Index k = n - 1; k >= 2; --k) {
    sums.merge(history.merges[static_cast<std::size_t>(n - 1 - k)]);
    silhouettes[static_cast<std::size_t>(k)] = sums.mean_silhouette();
  }
  return silhouettes;
}

}  // namespace svnet::semantics
