#include "semantics/clusterer.h"

namespace svnet::semantics {
namespace {

/// What the algorithms draw from.
struct Draws {
  std::uint64_t seed, number;
};

/// Calls the algorithm with `input`, that is distances or distances and rows, and a random stream if it takes one.
template <class Algorithm, class... Input>
void run(Algorithm& algorithm, Index k, Draws draws, std::span<std::int32_t> labels, const Input&... input) {
  if constexpr (requires(RandomStream random) { algorithm.cluster(input..., k, random, labels); })
    algorithm.cluster(input..., k, RandomStream(draws.seed, Stream::kmeans, draws.number), labels);
  else
    algorithm.cluster(input..., k, labels);
}

}  // namespace

Clusterer::Clusterer(const ClusteringOptions& options, Index max_points, Index max_clusters)
    : algorithm_(clustering_algorithm(options, max_points, max_clusters)) {}

void Clusterer::cluster(const DistanceMatrix& distances, std::span<const std::int32_t> rows, Index k,
                        std::uint64_t seed, std::uint64_t number, std::span<std::int32_t> labels) {
  std::visit([&](auto& algorithm) { run(algorithm, k, {seed, number}, labels, distances, rows); }, algorithm_);
}

void Clusterer::cluster(const LowerTriangle& distances, Index k, std::uint64_t seed, std::uint64_t number,
                        std::span<std::int32_t> labels) {
  std::visit([&](auto& algorithm) { run(algorithm, k, {seed, number}, labels, distances); }, algorithm_);
}

}  // namespace svnet::semantics
