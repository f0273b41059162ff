#include "semantics/agglomerative.h"

#include <algorithm>

#include "base/error.h"
#include "semantics/agglomerate.h"

namespace svnet::semantics {

Agglomerative::Agglomerative(Linkage linkage, Index max_points)
    : linkage_(linkage),
      dissimilarity_(max_points),
      size_(max_points + 31),
      gone_(max_points + 31),
      nearest_value_(max_points + 31),
      nearest_(max_points + 31),
      merged_into_(max_points + 31) {}

void Agglomerative::cluster(const DistanceMatrix& distances, std::span<const std::int32_t> rows, Index k,
                            std::span<std::int32_t> labels) {
  check_sizes(rows.size(), k, labels.size());
  dissimilarity_.copy_rows(distances, rows);
  merge_to(k, nullptr, labels);
}

void Agglomerative::cluster(const LowerTriangle& distances, Index k, std::span<std::int32_t> labels) {
  check_sizes(distances.points, k, labels.size());
  dissimilarity_.resize(distances.points);
  merge_to(k, distances.values, labels);
}

void Agglomerative::check_sizes(Index points, Index k, Index labels) const {
  check(k >= 1 && k <= points, "[agglomerative] cannot make ", k, " clusters of ", points, " points; 1 to ", points,
        " are possible");
  check(points <= dissimilarity_.max_points(), "[agglomerative] ", points, " points, but memory was made for ",
        dissimilarity_.max_points());
  check(labels == points, "[agglomerative] ", labels, " labels for ", points, " points");
}

void Agglomerative::merge_to(Index k, const float* triangle, std::span<std::int32_t> labels) {
  const Index n = labels.size();
  agglomerate(linkage_, k,
              {n, dissimilarity_.stride(), triangle, dissimilarity_.row(0), size_.data(), gone_.data(),
               nearest_value_.data(), nearest_.data(), merged_into_.data()});
  std::int32_t next = 0;
  for (Index i = 0; i < n; ++i) {
    const std::int32_t into = merged_into_[i];
    labels[i] = into == i ? next++ : labels[into];
  }
}

}  // namespace svnet::semantics
