#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/enum_names.h"
#include "base/index.h"

namespace svnet {

/// What the individual Fowlkes-Mallows score of an item is worth whose true class has no other item, and which thus has
/// no true pair: 0, as scikit-learn takes 0/0, or NaN, to be left out of means. An item with true partners that the
/// clustering left alone has missed them: 0 in both cases.
enum class Singletons { zero, skip };
template <>
inline constexpr auto enum_names<Singletons> = std::to_array<EnumName<Singletons>>({{Singletons::zero, "zero"},
                                                                                    {Singletons::skip, "skip"}});

/// What mutual information is divided by: a mean of the two entropies.
enum class NmiAverage { arithmetic, geometric };
template <>
inline constexpr auto enum_names<NmiAverage> =
    std::to_array<EnumName<NmiAverage>>({{NmiAverage::arithmetic, "arithmetic"}, {NmiAverage::geometric, "geometric"}});

/// How two labellings of the same items meet: counts from which every metric follows, and the memory they need.
/// Pairs are counted in 64 bits. Not thread-safe.
class Contingency {
 public:
  explicit Contingency(Index max_items);

  /// Both labellings: numbers in [0, max_items), not necessarily all in use. Allocates nothing. Throws Error for no
  /// items, too many, lengths that differ and labels out of range.
  void count(std::span<const std::int32_t> truth, std::span<const std::int32_t> predicted);

  // Of the labellings counted last, as scikit-learn defines them.
  double fowlkes_mallows() const;
  double normalized_mutual_info(NmiAverage average) const;
  /// The share of items whose class is the most frequent one of their cluster.
  double purity() const;
  double adjusted_rand() const;

  /// Of item i, TP / sqrt((TP + FP)(TP + FN)) over the pairs that contain i (PAPER.md section 4); values: one per item.
  void fowlkes_mallows_individual(Singletons singletons, std::span<double> values) const;

 private:
  /// The items of one class in one cluster: at least one.
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
  std::vector<std::int64_t> majority_;  // per cluster, the items of its most frequent class
  std::vector<Cell> cell_;
  std::vector<std::int32_t> cell_of_item_;
  std::vector<std::int32_t> first_of_class_, by_class_;  // items sorted by class
  std::vector<std::int32_t> cell_of_cluster_;            // of the class at hand
};

// The same of labels that are any integers.
using Labels = std::span<const std::int64_t>;
double fowlkes_mallows(Labels truth, Labels predicted);
std::vector<double> fowlkes_mallows_individual(Labels truth, Labels predicted,
                                               Singletons singletons = Singletons::zero);
double normalized_mutual_info(Labels truth, Labels predicted, NmiAverage average = NmiAverage::arithmetic);
double purity(Labels truth, Labels predicted);
double adjusted_rand(Labels truth, Labels predicted);

}  // namespace svnet
