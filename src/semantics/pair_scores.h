#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "semantics/cluster_metrics.h"

namespace svnet::semantics {

/// The Fowlkes-Mallows scores of Contingency without the other metrics: faster, for many problems. Pairs are counted in
/// integers. Not thread-safe.
class PairScores {
 public:
  explicit PairScores(Index max_categories);

  /// Sets individual[i] to the score of item i; NaN if it is a singleton and Singletons::skip is given. Returns the
  /// score of the problem. Requires: labels in [0, max_categories). Allocates nothing.
  double score(std::span<const std::int32_t> truth, std::span<const std::int32_t> prediction, Singletons singletons,
               std::span<double> individual);

 private:
  Index max_categories_;
  std::vector<std::int32_t> cell_;  // (categories, clusters) item counts; all 0 between calls
  std::vector<std::int32_t> class_size_, cluster_size_;
};

}  // namespace svnet::semantics
