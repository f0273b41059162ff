#pragma once
#include <cstdint>
#include <limits>
#include <string>

#include "data/scores.h"

namespace svnet {

/// The number of problems per view, and how certain the scores are. A mean over no views is NaN.
struct ScoresSummary {
  std::uint64_t fewest = std::numeric_limits<std::uint64_t>::max(), most = 0;  ///< problems per view, if not 0
  std::size_t left_out = 0;                                                    ///< views that were in no problem
  double largest_error = 0, mean_error = 0, mean_stability = 0;
};
ScoresSummary summary(const Scores& scores);

/// The summary, as one or two lines.
std::string certainty_text(const Scores& scores);

}  // namespace svnet
