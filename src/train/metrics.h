#pragma once
#include <array>

#include "semantics/cluster_metrics.h"

namespace svnet {

/// A number that says how well a clustering agrees with the categories.
struct Metric {
  const char* name;   ///< in evaluation.json
  const char* title;  ///< in tables for people
  double (*value)(const Contingency& counts, NmiAverage average);
};

/// All metrics of the tables. To add one, add a line.
inline constexpr std::array kMetrics{
    Metric{"fm", "FM", [](const Contingency& counts, NmiAverage) { return counts.fowlkes_mallows(); }},
    Metric{"nmi", "NMI",
           [](const Contingency& counts, NmiAverage average) { return counts.normalized_mutual_info(average); }},
    Metric{"purity", "purity", [](const Contingency& counts, NmiAverage) { return counts.purity(); }},
};

/// One value of each metric.
template <class T>
using PerMetric = std::array<T, kMetrics.size()>;

}  // namespace svnet
