// Greedy k-means++: Arthur and Vassilvitskii, "k-means++: the advantages of careful seeding" (SODA 2007), section 5.
// Distances to means computed from distances between points: Schoenberg 1935; the "kernel k-means" form of Lloyd.
#include "semantics/kmeans.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.h"
#include "semantics/kmeans_kernels.h"

namespace svnet::semantics {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

KMeans::KMeans(Index max_points, Index max_clusters, Index dimension, const KMeansOptions& options)
    : max_points_(max_points),
      max_clusters_(max_clusters),
      dimension_(dimension),
      options_(options),
      distance_(max_points),
      initial_(max_clusters),
      closest_(max_points + 31),
      cumulative_(max_points),
      cluster_sum_(max_clusters * (max_points + 31)),
      cluster_size_(max_clusters),
      half_spread_(max_clusters),
      shift_(max_clusters),
      scale_(max_clusters),
      member_of_(max_points),
      next_member_of_(max_points),
      nearest_(max_points + 31),
      nearest_index_(max_points + 31),
      labels_(max_points),
      previous_labels_(max_points),
      members_(max_clusters),
      label_of_cluster_(max_clusters) {
  check(dimension >= 1, "[kmeans] the features have dimension ", dimension, "; at least 1 is needed");
  check(options.n_init >= 1, "[kmeans] n_init is ", options.n_init, "; at least 1 is needed");
  check(options.max_iterations >= 1, "[kmeans] max_iterations is ", options.max_iterations, "; at least 1 is needed");
  check(options.tolerance >= 0, "[kmeans] tolerance is ", options.tolerance, "; it must not be negative");
}

double KMeans::cluster(const DistanceMatrix& distances, std::span<const std::int32_t> rows, Index k,
                       RandomStream random, std::span<std::int32_t> labels) {
  check_sizes(rows.size(), k, labels.size());
  distance_.copy_rows(distances, rows);
  start(rows.size(), k);
  return best_run(random, labels);
}

double KMeans::cluster(const LowerTriangle& distances, Index k, RandomStream random, std::span<std::int32_t> labels) {
  check_sizes(distances.points, k, labels.size());
  distance_.copy(distances);
  start(distances.points, k);
  return best_run(random, labels);
}

double KMeans::run_from(const DistanceMatrix& distances, std::span<const std::int32_t> rows,
                        std::span<const std::int32_t> initial, std::span<std::int32_t> labels) {
  const Index n = rows.size(), k = initial.size();
  check_sizes(n, k, labels.size());
  for (std::int32_t point : initial)
    check(point >= 0 && point < n, "[kmeans] initial centre ", point, " is not one of the ", n, " points");
  distance_.copy_rows(distances, rows);
  start(n, k);
  std::copy(initial.begin(), initial.end(), initial_.begin());
  return lloyd(labels);
}

void KMeans::check_sizes(Index points, Index k, Index labels) const {
  check(k >= 1 && k <= points, "[kmeans] cannot make ", k, " clusters of ", points, " points; 1 to ", points,
        " are possible");
  check(points <= max_points_ && k <= max_clusters_, "[kmeans] ", points, " points in ", k,
        " clusters, but memory was made for ", max_points_, " in ", max_clusters_);
  check(labels == points, "[kmeans] ", labels, " labels for ", points, " points");
}

void KMeans::start(Index points, Index k) {
  n_ = points;
  k_ = k;
  double total = 0;
  for (Index i = 0; i < n_; ++i) {
    float* row = distance_.row(i);
    for (Index j = 0; j < i; ++j) total += distance_.row(j)[i] = row[j];
    row[i] = 0;
    std::fill_n(row + n_, (n_ + 15) / 16 * 16 - n_, 0.0f);  // the padding of a triangle is undefined
  }
  // The sum of the variances of all features is half the mean squared distance of ordered pairs.
  const double variance = total / (static_cast<double>(n_) * n_);
  tolerance_ = options_.tolerance * variance / dimension_;
}

double KMeans::best_run(RandomStream random, std::span<std::int32_t> labels) {
  const std::span run_labels(labels_.data(), n_);
  double best = kInfinity;
  for (Index run = 0; run < options_.n_init; ++run) {
    choose_initial(random);
    const double inertia = lloyd(run_labels);
    if (inertia < best) {
      best = inertia;
      std::copy(run_labels.begin(), run_labels.end(), labels.begin());
    }
  }
  std::fill_n(label_of_cluster_.begin(), k_, -1);
  std::int32_t next = 0;
  for (auto& label : labels) {
    if (label_of_cluster_[label] < 0) label_of_cluster_[label] = next++;
    label = label_of_cluster_[label];
  }
  return best;
}

void KMeans::choose_initial(RandomStream& random) {
  initial_[0] = random.below(n_);
  std::copy_n(distance_.row(initial_[0]), n_, closest_.data());
  std::fill_n(closest_.data() + n_, 31, 0.0f);
  const Index trials = 2 + static_cast<Index>(std::log(static_cast<double>(k_)));
  for (Index c = 1; c < k_; ++c) {
    double sum = 0;
    for (Index i = 0; i < n_; ++i) cumulative_[i] = sum += closest_[i];
    double best = kInfinity;
    for (Index trial = 0; trial < trials; ++trial) {
      const double target = random.uniform() * sum;
      const Index found = std::lower_bound(cumulative_.begin(), cumulative_.begin() + n_, target) - cumulative_.begin();
      const Index candidate = std::min(found, n_ - 1);
      const double potential = kmeans::potential(closest_.data(), distance_.row(candidate), n_);
      if (potential < best) {
        best = potential;
        initial_[c] = candidate;
      }
    }
    kmeans::take_minimum(distance_.row(initial_[c]), n_, closest_.data());
  }
}

double KMeans::lloyd(std::span<std::int32_t> labels) {
  const auto inertia = [&] { return std::accumulate(nearest_.data(), nearest_.data() + n_, 0.0); };
  start_at_initial();
  std::fill_n(previous_labels_.begin(), n_, -1);
  for (Index iteration = 0; iteration < options_.max_iterations; ++iteration) {
    assign(labels);
    fill_empty_clusters(labels);
    const double shift = move_centres();
    if (options_.after_iteration) options_.after_iteration();
    if (std::equal(labels.begin(), labels.end(), previous_labels_.begin())) {
      for (Index i = 0; i < n_; ++i) nearest_[i] = std::max(0.0, to_centre(i, labels[i]));
      return inertia();
    }
    if (shift <= tolerance_) break;
    std::copy(labels.begin(), labels.end(), previous_labels_.begin());
  }
  assign(labels);  // to the last centres
  return inertia();
}

void KMeans::start_at_initial() {
  std::fill_n(member_of_.begin(), n_, -1);
  for (Index c = 0; c < k_; ++c) {
    std::copy_n(distance_.row(initial_[c]), n_, sum_of(c));
    cluster_size_[c] = 1;
    half_spread_[c] = 0;
  }
}

double KMeans::to_centre(Index point, Index cluster) const {
  return sum_of(cluster)[point] / cluster_size_[cluster] - half_spread_[cluster];
}

/// Assigns every point to its nearest centre, the first one in a tie.
void KMeans::assign(std::span<std::int32_t> labels) {
  for (Index c = 0; c < k_; ++c) scale_[c] = cluster_size_[c] == 0 ? 0 : 1 / cluster_size_[c];
  kmeans::assign(cluster_sum_.data(), distance_.stride(), scale_.data(), half_spread_.data(), k_, n_, nearest_.data(),
                 nearest_index_.data());
  for (Index i = 0; i < n_; ++i) labels[i] = static_cast<std::int32_t>(nearest_index_[i]);
}

/// Sets next_member_of_ to the labels, except that clusters without a point take the farthest points. Sets shift_[c] to
/// the sum of the squared distances of the points of cluster c to its present centre.
void KMeans::fill_empty_clusters(std::span<const std::int32_t> labels) {
  std::fill_n(members_.begin(), k_, 0);
  std::fill_n(shift_.begin(), k_, 0.0);
  for (Index i = 0; i < n_; ++i) {
    next_member_of_[i] = labels[i];
    ++members_[labels[i]];
    shift_[labels[i]] += nearest_[i];
  }
  for (Index c = 0; c < k_; ++c) {
    if (members_[c] > 0) continue;
    Index farthest = -1;
    for (Index i = 0; i < n_; ++i) {
      const bool movable = next_member_of_[i] == labels[i] && members_[labels[i]] > 1 && nearest_[i] > 0;
      if (movable && (farthest < 0 || nearest_[i] > nearest_[farthest])) farthest = i;
    }
    if (farthest < 0) return;  // fewer distinct points than clusters
    shift_[labels[farthest]] -= nearest_[farthest];
    --members_[labels[farthest]];
    if (cluster_size_[c] > 0) shift_[c] += std::max(0.0, to_centre(farthest, c));
    ++members_[c];
    next_member_of_[farthest] = c;
  }
}

/// Moves the centres to the means of next_member_of_. Returns the sum of the squared moves. The squared distance of an
/// old centre to the mean of S is the mean squared distance of S to the old centre, minus half the spread of S.
double KMeans::move_centres() {
  if (member_of_[0] < 0) {  // the centres are still the initial points
    std::fill_n(cluster_sum_.data(), k_ * distance_.stride(), 0.0);
    std::fill_n(cluster_size_.begin(), k_, 0.0);
  }
  for (Index i = 0; i < n_; ++i) {
    const std::int32_t from = member_of_[i], to = next_member_of_[i];
    if (from == to) continue;
    if (from >= 0) {
      kmeans::add_row(distance_.row(i), -1, n_, sum_of(from));
      --cluster_size_[from];
    }
    kmeans::add_row(distance_.row(i), 1, n_, sum_of(to));
    ++cluster_size_[to];
    member_of_[i] = to;
  }
  std::fill_n(half_spread_.begin(), k_, 0.0);
  for (Index i = 0; i < n_; ++i) half_spread_[member_of_[i]] += sum_of(member_of_[i])[i];
  double total = 0;
  for (Index c = 0; c < k_; ++c) {
    if (cluster_size_[c] == 0) continue;
    half_spread_[c] /= 2 * cluster_size_[c] * cluster_size_[c];
    total += std::max(0.0, shift_[c] / cluster_size_[c] - half_spread_[c]);
  }
  return total;
}

}  // namespace svnet::semantics
