#pragma once
#include <cstdint>
#include <limits>
#include <string>

#include "data/scores.h"

namespace svnet {

/// In how many problems views were, and how well their scores are known. Means over nothing are NaN.
struct ScoresSummary {
  std::uint64_t fewest = std::numeric_limits<std::uint64_t>::max(), most = 0;  ///< problems of a view that was in any
  std::size_t left_out = 0;                                                    ///< views that were in none
  double largest_error = 0, mean_error = 0, mean_stability = 0;
};
ScoresSummary summary(const Scores& scores);

/// How well scores are known, in a line or two.
std::string certainty_text(const Scores& scores);

}  // namespace svnet
