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
  std::string input_fingerprint;  // of everything that the values depend on: equal fingerprints mean equal scores
};

/// The semantic scores of every view of a dataset; entry i belongs to paths[i]. A score is NaN if the view was in no
/// problem (count 0; excluded views) or only in problems that do not count for it.
struct Scores : ScoresOrigin {
  std::vector<double> individual;      // mean individual score, [0, 1]
  std::vector<double> global;          // mean score of the problems with this view, [0, 1]
  std::vector<double> scaled;          // the training target: scaled to [0, 1] among the views of a pose
  std::vector<std::uint64_t> count;    // problems with this view
  std::vector<double> standard_error;  // of `individual`
  std::vector<double> rank_stability;  // of the view's pose: Kendall's tau between the orders of its views in
                                       // even and in odd problems, [-1, 1]
  std::vector<std::string> paths;      // as the dataset names its images
};

}  // namespace svnet
