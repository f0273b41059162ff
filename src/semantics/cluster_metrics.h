#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/enum_names.h"
#include "base/index.h"

namespace svnet::semantics {

/// The individual Fowlkes-Mallows score of a singleton, an item whose class has no other item. Its score is 0/0.
/// zero: the score is 0, as in scikit-learn. skip: the score is NaN, and means leave it out.
/// An item that has true partners but is alone in its cluster is not a singleton; its score is 0.
enum class Singletons { zero, skip };
constexpr auto enum_table(Singletons) {
  return std::to_array<EnumName<Singletons>>({{Singletons::zero, "zero"}, {Singletons::skip, "skip"}});
}

/// The mean of the two entropies by which mutual information is divided.
enum class NmiAverage { arithmetic, geometric };
constexpr auto enum_table(NmiAverage) {
  return std::to_array<EnumName<NmiAverage>>(
      {{NmiAverage::arithmetic, "arithmetic"}, {NmiAverage::geometric, "geometric"}});
}

/// The contingency table of two labellings of the same items, and the metrics that follow from it. Pairs are counted in
/// 64 bits. Not thread-safe.
class Contingency {
 public:
  explicit Contingency(Index max_items);

  /// Counts two labellings. Requires: at least one and at most max_items items, as many true as predicted labels, and
  /// labels in [0, max_items); gaps are allowed. Throws Error otherwise. Allocates nothing.
  void count(std::span<const std::int32_t> truth, std::span<const std::int32_t> predicted);

  // Metrics of the labellings that were counted last, as scikit-learn defines them.
  double fowlkes_mallows() const;
  double normalized_mutual_info(NmiAverage average) const;
  /// The fraction of items whose class is the most frequent one in their cluster.
  double purity() const;
  double adjusted_rand() const;

  /// Sets values[i] to TP / sqrt((TP + FP)(TP + FN)) over the pairs that contain item i (PAPER.md section 4).
  void fowlkes_mallows_individual(Singletons singletons, std::span<double> values) const;

 private:
  /// One non-zero cell of the contingency table.
  struct Cell {
    std::int32_t true_class, cluster;
    std::int64_t items;
  };
  struct Pairs {
    double together_in_both, together_in_truth, together_in_prediction;  // ordered pairs
  };
  Pairs pairs() const;

  Index max_items_, n_ = 0, classes_ = 0, clusters_ = 0;  // labels in [0, classes_), [0, clusters_)
  Index cells_ = 0;
  std::vector<std::int64_t> class_size_, cluster_size_;
  std::vector<std::int64_t> majority_;  // per cluster: items of its most frequent class
  std::vector<Cell> cell_;
  std::vector<std::int32_t> cell_of_item_;
  std::vector<std::int32_t> first_of_class_, by_class_;  // items sorted by class
  std::vector<std::int32_t> cell_of_cluster_;            // for the class that is being counted
};

// The same metrics for labels that may be any integers. Throw Error for no items and for lengths that differ.
using Labels = std::span<const std::int64_t>;
double fowlkes_mallows(Labels truth, Labels predicted);
std::vector<double> fowlkes_mallows_individual(Labels truth, Labels predicted,
                                               Singletons singletons = Singletons::zero);
double normalized_mutual_info(Labels truth, Labels predicted, NmiAverage average = NmiAverage::arithmetic);
double purity(Labels truth, Labels predicted);
double adjusted_rand(Labels truth, Labels predicted);

}  // namespace svnet::semantics
