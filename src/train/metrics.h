#pragma once
#include <array>

#include "semantics/cluster_metrics.h"

namespace svnet::train {

/// A number that says how well a clustering agrees with the categories.
struct Metric {
  const char* name;   ///< in evaluation.json
  const char* title;  ///< in tables for people
  const char* help;   ///< what it says, in a few words
  double (*value)(const semantics::Contingency& counts, semantics::NmiAverage average);
};

/// All metrics of the tables. To add one, add a line.
inline constexpr std::array kMetrics{
    Metric{"fm", "FM",
           "Fowlkes-Mallows index: of the pairs of views put together, and of those of one category, the share that is "
           "right",
           [](const semantics::Contingency& counts, semantics::NmiAverage) { return counts.fowlkes_mallows(); }},
    Metric{"nmi", "NMI", "normalised mutual information: how much a view's cluster says of its category",
           [](const semantics::Contingency& counts, semantics::NmiAverage average) {
             return counts.normalized_mutual_info(average);
           }},
    Metric{"purity", "purity", "share of views whose category is the most frequent one of their cluster",
           [](const semantics::Contingency& counts, semantics::NmiAverage) { return counts.purity(); }},
};

/// One value of each metric.
template <class T>
using PerMetric = std::array<T, kMetrics.size()>;

}  // namespace svnet::train
