#pragma once
#include <cstdint>
#include <span>
#include <variant>

#include "semantics/agglomerative.h"
#include "semantics/kmeans.h"

namespace svnet {

struct ClusteringOptions {
  enum class Method { agglomerative, kmeans };
  Method method = Method::agglomerative;
  Linkage linkage = Linkage::ward;
  KMeansOptions kmeans{};
  Index dimension = 1;  ///< of the features; k-means' tolerance needs it
};

/// The clustering algorithm that the options name, and the memory it needs. Not thread-safe: one object per thread.
class Clusterer {
 public:
  Clusterer(const ClusteringOptions& options, Index max_points, Index max_clusters);

  /// labels[i] is the cluster of rows[i], numbered from 0 in order of first appearance. Problem `number` has random
  /// numbers of its own. Allocates nothing. Throws Error for k outside [1, rows.size()].
  void cluster(const DistanceMatrix& distances, std::span<const std::int32_t> rows, Index k, std::uint64_t seed,
               std::uint64_t number, std::span<std::int32_t> labels);
  /// The same of points whose distances are already together.
  void cluster(const LowerTriangle& distances, Index k, std::uint64_t seed, std::uint64_t number,
               std::span<std::int32_t> labels);

 private:
  std::variant<Agglomerative, KMeans> algorithm_;
};

}  // namespace svnet
