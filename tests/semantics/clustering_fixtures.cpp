#include "semantics/clustering_fixtures.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace {

using svnet::Index;

template <class Value>
std::vector<Value> values(std::istream& in, Index count) {
  std::vector<Value> read(count);
  for (auto& value : read) in >> value;
  return read;
}

template <class Value>
Value value(std::istream& in) {
  Value read{};
  in >> read;
  return read;
}

ClusteringFixtures read_fixtures() {
  const std::string path = SVNET_FIXTURES "/clustering.txt";
  std::ifstream file(path);
  ClusteringFixtures fixtures;
  for (std::string line; std::getline(file, line);) {
    std::istringstream in(line);
    const auto word = value<std::string>(in);
    if (word == "points") {
      auto& points = fixtures.points.emplace_back();
      in >> points.n >> points.dimension;
      points.features = values<float>(file, points.n * points.dimension);
      std::getline(file, line);
    } else if (word == "metrics") {
      const auto n = value<Index>(in);
      auto& metrics = fixtures.metrics.emplace_back();
      metrics.truth = values<std::int64_t>(in, n);
      metrics.predicted = values<std::int64_t>(in, n);
      in >> metrics.fowlkes_mallows >> metrics.nmi_arithmetic >> metrics.nmi_geometric >> metrics.purity >>
          metrics.adjusted_rand;
    } else if (fixtures.points.empty()) {
      throw std::runtime_error(path + ": '" + line + "' belongs to no points");
    } else {
      auto& points = fixtures.points.back();
      if (word == "partition") {
        auto& partition = points.partitions.emplace_back();
        in >> partition.linkage >> partition.k;
        partition.labels = values<std::int32_t>(in, points.n);
      } else if (word == "kmeans") {
        const auto k = value<Index>(in);
        auto& run = points.runs.emplace_back();
        in >> run.tolerance >> run.max_iterations;
        run.initial = values<std::int32_t>(in, k);
        run.labels = values<std::int32_t>(in, points.n);
        in >> run.inertia;
      } else if (word == "kmeans_best") {
        auto& best = points.best.emplace_back();
        in >> best.k >> best.inertia;
      } else if (word == "kmeans_single") {
        auto& single = points.single.emplace_back();
        in >> single.k >> single.runs >> single.mean >> single.standard_deviation;
      } else {
        throw std::runtime_error(path + ": unknown word '" + word + "'");
      }
    }
    if (!in || !file) throw std::runtime_error(path + ": too few values in '" + line + "'");
  }
  if (fixtures.points.empty() || fixtures.metrics.empty()) throw std::runtime_error(path + " is missing or empty");
  return fixtures;
}

}  // namespace

const ClusteringFixtures& clustering_fixtures() {
  static const ClusteringFixtures fixtures = read_fixtures();
  return fixtures;
}
