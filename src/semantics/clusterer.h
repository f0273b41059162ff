#pragma once
#include <cstdint>
#include <span>
#include <variant>

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
  std::variant<Agglomerative, KMeans> algorithm_;
};

}  // namespace svnet::semantics
