#pragma once
#include <array>

#include "semantics/cluster_metrics.h"

namespace svnet::train {

/// A number that says how well a clustering agrees with the categories.
struct Metric {
  const char* name;   ///< in evaluation.json
  const char* title;  ///< in tables for people
  double (*value)(const semantics::Contingency& counts, semantics::NmiAverage average);
};

/// All metrics of the tables. To add one, add a line.
inline constexpr std::array kMetrics{
    Metric{"fm", "FM",
           [](const semantics::Contingency& counts, semantics::NmiAverage) { return counts.fowlkes_mallows(); }},
    Metric{"nmi", "NMI",
           [](const semantics::Contingency& counts, semantics::NmiAverage average) {
             return counts.normalized_mutual_info(average);
           }},
    Metric{"purity", "purity",
           [](const semantics::Contingency& counts, semantics::NmiAverage) { return counts.purity(); }},
};

/// One value of each metric.
template <class T>
using PerMetric = std::array<T, kMetrics.size()>;

}  // namespace svnet::train
