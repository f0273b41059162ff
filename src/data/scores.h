#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/index.h"

namespace svnet {

/// How scores were made.
struct ScoresOrigin {
  Index problems = 0;  // clustering problems drawn
  std::uint64_t seed = 0;
  std::string sampler;            // how problems are drawn
  std::string clustering;         // "ward", "kmeans"
  std::string metric;             // "fm", …
  std::string input_fingerprint;  // of everything that the values depend on: scores with the same one are the same
};

/// The semantic scores of every view of a dataset; entry i belongs to paths[i]. NaN: there is none, because the view
/// was in no problem (count 0, as excluded views are) or in none that counts.
struct Scores : ScoresOrigin {
  std::vector<double> individual;      // mean individual score, [0, 1]
  std::vector<double> global;          // mean score of the problems with this view, [0, 1]
  std::vector<double> scaled;          // the training target: scaled to [0, 1] among the views of a pose
  std::vector<std::uint64_t> count;    // problems with this view
  std::vector<double> standard_error;  // of `individual`
  std::vector<double> rank_stability;  // of the view's pose: Kendall's tau of its views' order between half the
                                       // problems and the other half, [-1, 1]
  std::vector<std::string> paths;      // as the dataset names its images
};

}  // namespace svnet
