#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/index.h"

/// fixtures/clustering.txt: results of scikit-learn for small problems. The script next to it describes the fields.
struct ClusteringFixtures {
  struct Partition {
    std::string linkage;
    svnet::Index k;
    std::vector<std::int32_t> labels;
  };
  struct KMeansRun {
    double tolerance;
    svnet::Index max_iterations;
    std::vector<std::int32_t> initial, labels;
    double inertia;
  };
  struct BestInertia {
    svnet::Index k;
    double inertia;
  };
  struct SingleInertia {
    svnet::Index k, runs;
    double mean, standard_deviation;
  };
  struct Points {
    svnet::Index n, dimension;
    std::vector<float> features;
    std::vector<Partition> partitions;
    std::vector<KMeansRun> runs;
    std::vector<BestInertia> best;
    std::vector<SingleInertia> single;
  };
  struct Metrics {
    std::vector<std::int64_t> truth, predicted;
    double fowlkes_mallows, nmi_arithmetic, nmi_geometric, purity, adjusted_rand;
  };
  std::vector<Points> points;
  std::vector<Metrics> metrics;
};

/// Read once. Throws std::runtime_error if the file is missing or damaged.
const ClusteringFixtures& clustering_fixtures();
