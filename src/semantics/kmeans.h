#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/random.h"
#include "semantics/problem_distances.h"

namespace svnet::semantics {

struct KMeansOptions {
  Index n_init = 10;           ///< runs; the one with the lowest inertia is kept
  Index max_iterations = 300;  ///< per run
  /// A run ends if the sum of the squared moves of its centres, over the mean variance of a feature, is at most this.
  double tolerance = 1e-4;
  std::function<void()> after_iteration{};  ///< called after each iteration, if set; an exception stops the clustering
};

/// k-means of rows of a distance matrix, as scikit-learn's KMeans(algorithm="lloyd"), with its memory. Greedy k-means++
/// with 2 + floor(ln k) trials, then Lloyd. A cluster that lost all its points takes the point that is farthest from
/// its centre (ties: the first; a point that is alone in its cluster stays).
///
/// Centres are not computed. The squared distance of point i to the mean of a set S is
/// mean_{j in S} D_ij - 1/2 mean_{j,l in S} D_jl, so the cost does not depend on the dimension of the features.
/// All sums are in double. Not thread-safe: use one object per thread.
class KMeans {
 public:
  /// `dimension`: of the features, for the tolerance. Throws Error for a count below 1 or a negative tolerance.
  KMeans(Index max_points, Index max_clusters, Index dimension, const KMeansOptions& options = {});

  /// Sets labels[i] to the cluster of rows[i]; clusters are numbered from 0 in order of first appearance. Fewer than k
  /// distinct points give fewer clusters. Returns the inertia: the sum of squared distances to the centres. Allocates
  /// nothing. Throws Error if k is not in [1, rows.size()], or a size is above that of the constructor.
  double cluster(const DistanceMatrix& distances, std::span<const std::int32_t> rows, Index k, RandomStream random,
                 std::span<std::int32_t> labels);

  /// The same for the points of `distances`.
  double cluster(const LowerTriangle& distances, Index k, RandomStream random, std::span<std::int32_t> labels);

  /// One run from given centres: the points initial[c] in [0, rows.size()), with k = initial.size(). Sets labels[i] to
  /// the index of a centre. Returns the inertia.
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
  std::vector<double> cumulative_;     // (n) prefix sums of closest_
  AlignedArray<double> cluster_sum_;   // (k, stride) sum of D_ij over the points j that are averaged into centre c
  std::vector<double> cluster_size_, half_spread_, shift_;  // (k) half_spread_: 1/2 mean_{j,l} D_jl
  std::vector<double> scale_;                               // (k) 1 / cluster_size_, or 0
  std::vector<std::int32_t> member_of_, next_member_of_;    // (n) the centre that a point is averaged into
  AlignedArray<double> nearest_;                            // (n) squared distance to the centre of the label
  AlignedArray<double> nearest_index_;                      // (n) the label as a double
  std::vector<std::int32_t> labels_, previous_labels_;      // (n)
  std::vector<std::int32_t> members_;                       // (k) points that are averaged into the next centre
  std::vector<std::int32_t> label_of_cluster_;              // (k) in order of first appearance; -1: not yet seen
};

}  // namespace svnet::semantics
