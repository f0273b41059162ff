#include "semantics/pair_scores.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace svnet::semantics {

PairScores::PairScores(Index max_categories)
    : max_categories_(max_categories),
      cell_(max_categories * max_categories),
      class_size_(max_categories),
      cluster_size_(max_categories) {}

double PairScores::score(std::span<const std::int32_t> truth, std::span<const std::int32_t> prediction,
                         Singletons singletons, std::span<double> individual) {
  const std::size_t n = truth.size();
  for (std::size_t i = 0; i < n; ++i) {
    ++cell_[truth[i] * max_categories_ + prediction[i]];
    ++class_size_[truth[i]];
    ++cluster_size_[prediction[i]];
  }
  // Every item counts its own pairs, so the sums run over ordered pairs.
  std::int64_t both = 0, in_truth = 0, in_prediction = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::int64_t together = cell_[truth[i] * max_categories_ + prediction[i]] - 1;
    const std::int64_t true_partners = class_size_[truth[i]] - 1;
    const std::int64_t predicted_partners = cluster_size_[prediction[i]] - 1;
    both += together;
    in_truth += true_partners;
    in_prediction += predicted_partners;
    // 0/0 becomes 0/1: without a true or predicted partner the numerator is 0.
    const double pairs = std::max<std::int64_t>(true_partners * predicted_partners, 1);
    individual[i] = together / std::sqrt(pairs);
    if (singletons == Singletons::skip && true_partners == 0) individual[i] = std::numeric_limits<double>::quiet_NaN();
  }
  for (std::size_t i = 0; i < n; ++i) {
    cell_[truth[i] * max_categories_ + prediction[i]] = 0;
    class_size_[truth[i]] = cluster_size_[prediction[i]] = 0;
  }
  const double tp = both;
  return both == 0 ? 0 : std::sqrt(tp / in_truth) * std::sqrt(tp / in_prediction);
}

}  // namespace svnet::semantics
