#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/index.h"

/// fixtures/clustering.txt: what scikit-learn makes of small problems. The script beside it says what the fields are.
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

/// Read once; throws std::runtime_error where the file is missing or broken.
const ClusteringFixtures& clustering_fixtures();
