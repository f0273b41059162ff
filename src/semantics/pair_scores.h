#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "semantics/cluster_metrics.h"

namespace svnet {

/// Fowlkes-Mallows scores of one problem after the other, as Contingency computes them, from pair counts in integers
/// and without the rest. Not thread-safe.
class PairScores {
 public:
  explicit PairScores(Index max_categories);

  /// truth and prediction: labels in [0, max_categories). individual[i] becomes the score of item i, NaN where
  /// `singletons` leaves it out. Returns the score of the problem. Allocates nothing.
  double score(std::span<const std::int32_t> truth, std::span<const std::int32_t> prediction, Singletons singletons,
               std::span<double> individual);

 private:
  Index max_categories_;
  std::vector<std::int32_t> cell_;  // (categories, clusters) items; all 0 between calls
  std::vector<std::int32_t> class_size_, cluster_size_;
};

}  // namespace svnet
