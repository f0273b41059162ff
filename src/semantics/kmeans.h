#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/random.h"
#include "semantics/problem_distances.h"

namespace svnet {

struct KMeansOptions {
  Index n_init = 10;           ///< runs, of which the one with the lowest inertia is kept
  Index max_iterations = 300;  ///< of one run
  double tolerance = 1e-4;  ///< a run ends when its centres move less: sum of squares, over the mean feature variance
  std::function<void()> after_iteration{};  ///< if any, called after each one: to stop by an exception
};

/// k-means of some rows of a distance matrix with the semantics of scikit-learn's KMeans(algorithm="lloyd"), and the
/// memory it needs. Greedy k-means++ with 2 + floor(ln k) trials, then Lloyd; a cluster that lost all its points takes
/// the point farthest from its centre (ties: the first; a point that is alone in its cluster stays).
///
/// Centres never exist. The squared distance of point i to the mean of a set S is
/// mean_{j in S} D_ij - 1/2 mean_{j,l in S} D_jl, so that the cost does not depend on the dimension of the features.
/// All sums are in double. Not thread-safe: one object per thread.
class KMeans {
 public:
  /// `dimension` of the features: only the tolerance needs it. Throws Error for options below 1 or a negative
  /// tolerance.
  KMeans(Index max_points, Index max_clusters, Index dimension, const KMeansOptions& options = {});

  /// labels[i] is the cluster of rows[i], numbered from 0 in order of first appearance. Returns the inertia, the sum of
  /// squared distances to the centres. With fewer than k distinct points there are fewer clusters. Allocates nothing.
  /// Throws Error for k outside [1, rows.size()] and for sizes beyond those of the constructor.
  double cluster(const DistanceMatrix& distances, std::span<const std::int32_t> rows, Index k, RandomStream random,
                 std::span<std::int32_t> labels);

  /// The same of points whose distances are already together.
  double cluster(const LowerTriangle& distances, Index k, RandomStream random, std::span<std::int32_t> labels);

  /// One run that starts from the points initial[c] in [0, rows.size()) as centres; k is their number. Labels are the
  /// numbers of the centres.
  double run_from(const DistanceMatrix& distances, std::span<const std::int32_t> rows,
                  std::span<const std::int32_t> initial, std::span<std::int32_t> labels);

 private:
  void check_sizes(Index points, Index k, Index labels) const;
  void start(Index points, Index k);
  double best_run(RandomStream random, std::span<std::int32_t> labels);
  void choose_initial(RandomStream& random);
  double lloyd(std::span<std::int32_t> labels);
  void start_at_initial();
  void assign(std::span<std::int32_t> labels);
  void fill_empty_clusters(std::span<const std::int32_t> labels);
  double move_centres();
  double to_centre(Index point, Index cluster) const;
  double* sum_of(Index cluster) { return cluster_sum_.data() + cluster * distance_.stride(); }
  const double* sum_of(Index cluster) const { return cluster_sum_.data() + cluster * distance_.stride(); }

  Index max_points_, max_clusters_, dimension_;
  KMeansOptions options_;
  Index n_ = 0, k_ = 0;
  double tolerance_ = 0;               // options_.tolerance times the mean variance of the features
  ProblemDistances distance_;          // (n, n)
  std::vector<std::int32_t> initial_;  // (k) points
  AlignedArray<float> closest_;        // (n) k-means++: squared distance to the nearest centre
  std::vector<double> cumulative_;     // (n) its sums
  AlignedArray<double> cluster_sum_;   // (k, stride) sum of D_ij over the points j behind centre c
  std::vector<double> cluster_size_, half_spread_, shift_;  // (k) half_spread_: 1/2 mean_{j,l} D_jl
  std::vector<double> scale_;                               // (k) 1 / cluster_size_, or 0
  std::vector<std::int32_t> behind_, next_behind_;          // (n) the centre that a point is averaged into
  AlignedArray<double> nearest_;                            // (n) squared distance to the centre of the label
  AlignedArray<double> nearest_number_;                     // (n) the label as a float
  std::vector<std::int32_t> labels_, previous_labels_;      // (n)
  std::vector<std::int32_t> members_;                       // (k) points behind the next centre
  std::vector<std::int32_t> number_;                        // (k) of a cluster, in order of first appearance
};

}  // namespace svnet
