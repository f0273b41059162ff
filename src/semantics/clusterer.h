#pragma once
#include <cstdint>
#include <span>
#include <variant>

#include "base/error.h"
#include "semantics/agglomerative.h"
#include "semantics/kmeans.h"

namespace svnet::semantics {

/// The algorithms: agglomerative clustering by its linkage, and k-means.
enum class Clustering { ward, average, complete, single, kmeans };
constexpr auto enum_table(Clustering) {
  return std::to_array<EnumName<Clustering>>({{Clustering::ward, name_of(Linkage::ward)},
                                              {Clustering::average, name_of(Linkage::average)},
                                              {Clustering::complete, name_of(Linkage::complete)},
                                              {Clustering::single, name_of(Linkage::single)},
                                              {Clustering::kmeans, "kmeans"}});
}

struct ClusteringOptions {
  Clustering method = Clustering::ward;
  KMeansOptions kmeans{};
  Index dimension = 1;  ///< of the features; used by the tolerance of k-means
};

/// One alternative per algorithm. Each has cluster(distances, k, labels) and cluster(distances, rows, k, labels), or
/// the same with a RandomStream before the labels.
using ClusteringAlgorithm = std::variant<Agglomerative, KMeans>;

inline ClusteringAlgorithm clustering_algorithm(const ClusteringOptions& options, Index max_points,
                                                Index max_clusters) {
  switch (options.method) {
    case Clustering::ward:
      return Agglomerative(Linkage::ward, max_points);
    case Clustering::average:
      return Agglomerative(Linkage::average, max_points);
    case Clustering::complete:
      return Agglomerative(Linkage::complete, max_points);
    case Clustering::single:
      return Agglomerative(Linkage::single, max_points);
    case Clustering::kmeans:
      return KMeans(max_points, max_clusters, options.dimension, options.kmeans);
  }
  fail("[clustering] no algorithm has this number");
}

/// The clustering algorithm of the options, with its memory. Not thread-safe: use one object per thread.
class Clusterer {
 public:
  Clusterer(const ClusteringOptions& options, Index max_points, Index max_clusters);

  /// Sets labels[i] to the cluster of rows[i]; clusters are numbered from 0 in order of first appearance. k-means draws
  /// from the random stream (seed, number). Allocates nothing. Throws Error if k is not in [1, rows.size()].
  void cluster(const DistanceMatrix& distances, std::span<const std::int32_t> rows, Index k, std::uint64_t seed,
               std::uint64_t number, std::span<std::int32_t> labels);
  /// The same for the points of `distances`.
  void cluster(const LowerTriangle& distances, Index k, std::uint64_t seed, std::uint64_t number,
               std::span<std::int32_t> labels);

 private:
  ClusteringAlgorithm algorithm_;
};

}  // namespace svnet::semantics
