#include "semantics/agglomerative.h"

#include <algorithm>
#include <limits>

#include "base/error.h"
#include "semantics/agglomerate.h"

namespace svnet::semantics {

Agglomerative::Agglomerative(Linkage linkage, Index max_points)
    : linkage_(linkage),
      dissimilarity_(max_points),
      room_(max_points + 31),
      size_(room_),
      gone_(room_),
      scratch_(room_),
      nearest_value_(room_),
      next_value_(room_),
      sides_(3 * room_),
      nearest_(room_),
      merged_into_(room_) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  std::fill_n(sides_.data(), room_, kInfinity);
  std::fill_n(sides_.data() + 2 * room_, room_, kInfinity);
}

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
              {n, dissimilarity_.stride(), triangle, dissimilarity_.row(0), size_.data(), gone_.data(), scratch_.data(),
               sides_.data() + room_ - 1, sides_.data() + 2 * room_, nearest_value_.data(), next_value_.data(),
               nearest_.data(), merged_into_.data()});
  std::int32_t next = 0;
  for (Index i = 0; i < n; ++i) {
    const std::int32_t into = merged_into_[i];
    labels[i] = into == i ? next++ : labels[into];
  }
}

}  // namespace svnet::semantics
