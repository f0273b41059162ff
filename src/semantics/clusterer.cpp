#include "semantics/clusterer.h"

#include "base/error.h"

namespace svnet::semantics {
namespace {

std::variant<Agglomerative, KMeans> algorithm(const ClusteringOptions& options, Index max_points, Index max_clusters) {
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

}  // namespace

Clusterer::Clusterer(const ClusteringOptions& options, Index max_points, Index max_clusters)
    : algorithm_(algorithm(options, max_points, max_clusters)) {}

void Clusterer::cluster(const DistanceMatrix& distances, std::span<const std::int32_t> rows, Index k,
                        std::uint64_t seed, std::uint64_t number, std::span<std::int32_t> labels) {
  if (auto* agglomerative = std::get_if<Agglomerative>(&algorithm_))
    agglomerative->cluster(distances, rows, k, labels);
  else
    std::get<KMeans>(algorithm_).cluster(distances, rows, k, RandomStream(seed, Stream::kmeans, number), labels);
}

void Clusterer::cluster(const LowerTriangle& distances, Index k, std::uint64_t seed, std::uint64_t number,
                        std::span<std::int32_t> labels) {
  if (auto* agglomerative = std::get_if<Agglomerative>(&algorithm_))
    agglomerative->cluster(distances, k, labels);
  else
    std::get<KMeans>(algorithm_).cluster(distances, k, RandomStream(seed, Stream::kmeans, number), labels);
}

}  // namespace svnet::semantics
