#include "semantics/group_count.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"

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

/// The sum of distances from each item to each cluster while clusters are merged. A cluster is in the column of the
/// first item that it was made from.
class ClusterSums {
 public:
  explicit ClusterSums(const DistanceMatrix& distances) : n_(distances.size()) {
    const auto n = static_cast<std::size_t>(n_);
    sums_.resize(n * n);
    size_.assign(n, 1);
    for (Index i = 0; i < n_; ++i) {
      active_.push_back(i);
      column_of_item_.push_back(i);
      column_of_cluster_.push_back(i);
      for (Index j = 0; j < n_; ++j) sum(i, j) = std::sqrt(static_cast<double>(distances(i, j)));
    }
  }

  void merge(const Merge& merge) {
    const Index a = column_of_cluster_[static_cast<std::size_t>(merge.a)];
    const Index b = column_of_cluster_[static_cast<std::size_t>(merge.b)];
    for (Index i = 0; i < n_; ++i) sum(i, a) += sum(i, b);
    size_[static_cast<std::size_t>(a)] += size_[static_cast<std::size_t>(b)];
    std::erase(active_, b);
    std::ranges::replace(column_of_item_, b, a);
    column_of_cluster_.push_back(a);
  }

  double mean_silhouette() const {
    double total = 0;
    for (Index i = 0; i < n_; ++i) {
      const Index own = column_of_item_[static_cast<std::size_t>(i)];
      const double others = size_[static_cast<std::size_t>(own)] - 1;
      if (others == 0) continue;
      const double within = sum(i, own) / others;
      double nearest = std::numeric_limits<double>::infinity();
      for (const Index column : active_)
        if (column != own) nearest = std::min(nearest, sum(i, column) / size_[static_cast<std::size_t>(column)]);
      const double larger = std::max(within, nearest);
      if (larger > 0) total += (nearest - within) / larger;
    }
    return total / static_cast<double>(n_);
  }

 private:
  double& sum(Index item, Index column) { return sums_[static_cast<std::size_t>(item * n_ + column)]; }
  double sum(Index item, Index column) const { return sums_[static_cast<std::size_t>(item * n_ + column)]; }

  Index n_;
  std::vector<double> sums_{}, size_{};
  std::vector<Index> active_{}, column_of_item_{}, column_of_cluster_{};
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
