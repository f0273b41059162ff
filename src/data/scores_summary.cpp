#include "data/scores_summary.h"

#include <algorithm>
#include <cmath>
#include <iomanip>

#include "base/error.h"

namespace svnet {

ScoresSummary summary(const Scores& scores) {
  ScoresSummary s;
  double error_sum = 0, scored = 0, stability_sum = 0, ranked = 0;
  for (std::size_t v = 0; v < scores.paths.size(); ++v) {
    s.most = std::max(s.most, scores.count[v]);
    if (scores.count[v] == 0)
      ++s.left_out;
    else
      s.fewest = std::min(s.fewest, scores.count[v]);
    if (std::isfinite(scores.standard_error[v])) {
      s.largest_error = std::max(s.largest_error, scores.standard_error[v]);
      error_sum += scores.standard_error[v];
      ++scored;
    }
    if (std::isfinite(scores.rank_stability[v])) {
      stability_sum += scores.rank_stability[v];
      ++ranked;
    }
  }
  s.mean_error = error_sum / scored;
  s.mean_stability = stability_sum / ranked;
  return s;
}

std::string certainty_text(const Scores& scores) {
  const ScoresSummary s = summary(scores);
  if (std::isnan(s.mean_error)) return "too few problems to say how well the scores are known";
  std::string text = joined("every view was in at least ", s.fewest, " problems; standard error ", std::setprecision(2),
                            s.mean_error, " on average, ", s.largest_error, " at most");
  if (!std::isnan(s.mean_stability))
    text += joined("\nrank stability of the views of a pose (Kendall's tau between halves of the problems): ",
                   std::setprecision(3), s.mean_stability, " on average");
  return text;
}

}  // namespace svnet
