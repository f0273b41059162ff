// Agglomeration by the formulas of Lance and Williams (The Computer Journal 9, 1967), each cluster with its nearest
// later one. agglomerate.cpp does the same for many small problems, but keeps no history.
#include "semantics/dendrogram.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"

namespace svnet::semantics {
namespace {

/// The clusters while they are merged. A cluster is in the slot of its first item. Dissimilarities are squared
/// distances, but distances for average linkage.
class Merger {
 public:
  Merger(Linkage linkage, const DistanceMatrix& distances)
      : linkage_(linkage), n_(distances.size()), dissimilarity_(n_), slots_(static_cast<std::size_t>(n_)) {
    for (Index i = 0; i < n_; ++i) {
      slot(i).cluster = static_cast<std::int32_t>(i);
      const float* from = distances.row(i);
      float* to = dissimilarity_.row(i);
      for (Index j = 0; j < n_; ++j) to[j] = linkage_ == Linkage::average ? std::sqrt(from[j]) : from[j];
    }
    for (Index i = 0; i < n_; ++i) search(i);
  }

  Dendrogram merge_all() {
    Dendrogram result{n_, {}};
    double height = 0;
    for (Index m = 0; m + 1 < n_; ++m) {
      Index a = 0;
      for (Index i = 1; i < n_; ++i)
        if (slot(i).nearest_value < slot(a).nearest_value) a = i;
      const Index b = slot(a).nearest;
      const double value = slot(a).nearest_value;
      // The linkages are monotone; rounding may not be.
      height = std::max(height, linkage_ == Linkage::average ? value : std::sqrt(value));
      const auto [first, second] = std::minmax({slot(a).cluster, slot(b).cluster});
      merge(a, b);
      slot(a).cluster = static_cast<std::int32_t>(n_ + m);
      result.merges.push_back({first, second, height, static_cast<Index>(slot(a).size)});
    }
    return result;
  }

 private:
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();

  struct Slot {
    std::int32_t cluster = 0;
    bool gone = false;
    float size = 1;
    float nearest_value = kInfinity;  // infinity: there is no later slot
    Index nearest = -1;
  };
  Slot& slot(Index i) { return slots_[static_cast<std::size_t>(i)]; }

  /// Finds the nearest later slot; the first one in a tie.
  void search(Index i) {
    Slot& s = slot(i);
    s.nearest_value = kInfinity;
    const float* row = dissimilarity_.row(i);
    for (Index j = i + 1; j < n_; ++j)
      if (!slot(j).gone && row[j] < s.nearest_value) {
        s.nearest_value = row[j];
        s.nearest = j;
      }
  }

  /// The dissimilarity of slot `other` and the union of a and b: the operations of agglomerate.cpp in its order.
  float merged(Index other, Index a, Index b) {
    const float to_a = dissimilarity_(a, other), to_b = dissimilarity_(b, other), between = dissimilarity_(a, b);
    const float size = slot(other).size, of_a = slot(a).size, of_b = slot(b).size, both = of_a + of_b;
    switch (linkage_) {
      case Linkage::ward:
        return ((size + of_a) * to_a + (size + of_b) * to_b - size * between) / (size + both);
      case Linkage::average:
        return (of_a * to_a + of_b * to_b) / both;
      case Linkage::complete:
        return std::max(to_a, to_b);
      case Linkage::single:
        return std::min(to_a, to_b);
    }
    fail("[dendrogram] no linkage has this number");
  }

  void merge(Index a, Index b) {
    for (Index i = 0; i < n_; ++i) {
      if (i == a || i == b || slot(i).gone) continue;
      const float value = merged(i, a, b);
      dissimilarity_.row(a)[i] = dissimilarity_.row(i)[a] = value;
    }
    slot(a).size += slot(b).size;
    slot(b).gone = true;
    slot(b).nearest_value = kInfinity;
    search(a);
    for (Index i = 0; i < b; ++i) {
      Slot& s = slot(i);
      if (i == a || s.gone) continue;
      if (s.nearest == a || s.nearest == b) {
        search(i);
      } else if (const float value = dissimilarity_(i, a);
                 i < a && (value < s.nearest_value || (value == s.nearest_value && a < s.nearest))) {
        s.nearest_value = value;
        s.nearest = a;
      }
    }
  }

  Linkage linkage_;
  Index n_;
  DistanceMatrix dissimilarity_;  // symmetric
  std::vector<Slot> slots_;
};

}  // namespace

Dendrogram dendrogram(Linkage linkage, const DistanceMatrix& distances) {
  check(distances.size() > 0, "[dendrogram] there are no points");
  return Merger(linkage, distances).merge_all();
}

std::vector<std::int32_t> cut(const Dendrogram& dendrogram, Index k) {
  const Index n = dendrogram.items;
  check(k >= 1 && k <= n, "[dendrogram] cannot make ", k, " clusters of ", n, " items; 1 to ", n, " are possible");
  // The cluster that each cluster became a part of. Merges come in order, so later clusters know theirs first.
  std::vector<std::int32_t> whole(static_cast<std::size_t>(2 * n - k));
  for (std::size_t i = 0; i < whole.size(); ++i) whole[i] = static_cast<std::int32_t>(i);
  for (Index m = n - k - 1; m >= 0; --m) {
    const Merge& merge = dendrogram.merges[static_cast<std::size_t>(m)];
    const std::int32_t into = whole[static_cast<std::size_t>(n + m)];
    whole[static_cast<std::size_t>(merge.a)] = whole[static_cast<std::size_t>(merge.b)] = into;
  }
  std::vector<std::int32_t> label_of(whole.size(), -1), labels(static_cast<std::size_t>(n));
  std::int32_t next = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    std::int32_t& label = label_of[static_cast<std::size_t>(whole[i])];
    if (label < 0) label = next++;
    labels[i] = label;
  }
  return labels;
}

}  // namespace svnet::semantics
