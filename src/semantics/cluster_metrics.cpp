#include "semantics/cluster_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.h"

namespace svnet::semantics {
namespace {

/// Counts the labels into sizes. Returns the largest label + 1.
Index count_labels(std::span<const std::int32_t> labels, Index max_items, std::vector<std::int64_t>& sizes) {
  const auto [lowest, highest] = std::minmax_element(labels.begin(), labels.end());
  check(*lowest >= 0 && *highest < max_items, "[cluster metrics] labels from ", *lowest, " to ", *highest,
        " where 0 to ", max_items - 1, " are allowed");
  std::fill_n(sizes.begin(), *highest + 1, 0);
  for (std::int32_t label : labels) ++sizes[label];
  return *highest + 1;
}

Index groups(std::span<const std::int64_t> sizes) {
  return std::ssize(sizes) - std::count(sizes.begin(), sizes.end(), 0);
}

double entropy(std::span<const std::int64_t> sizes, double n) {
  double sum = 0;
  for (std::int64_t size : sizes)
    if (size > 0) sum -= size / n * (std::log(size) - std::log(n));
  return sum;
}

/// Replaces labels by 0, 1, …, in ascending order of their values.
std::vector<std::int32_t> dense(Labels labels) {
  std::vector<std::int64_t> values(labels.begin(), labels.end());
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  std::vector<std::int32_t> dense_labels(labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i)
    dense_labels[i] = std::lower_bound(values.begin(), values.end(), labels[i]) - values.begin();
  return dense_labels;
}

Contingency contingency(Labels truth, Labels predicted) {
  Contingency counted(std::max(truth.size(), predicted.size()));
  counted.count(dense(truth), dense(predicted));
  return counted;
}

}  // namespace

Contingency::Contingency(Index max_items)
    : max_items_(max_items),
      class_size_(max_items),
      cluster_size_(max_items),
      majority_(max_items),
      cell_(max_items),
      cell_of_item_(max_items),
      first_of_class_(max_items + 1),
      by_class_(max_items),
      cell_of_cluster_(max_items) {}

void Contingency::count(std::span<const std::int32_t> truth, std::span<const std::int32_t> predicted) {
  n_ = truth.size();
  check(truth.size() == predicted.size(), "[cluster metrics] ", truth.size(), " true labels for ", predicted.size(),
        " predicted ones");
  check(n_ >= 1, "[cluster metrics] there are no labels; one item at least is needed");
  check(n_ <= max_items_, "[cluster metrics] ", n_, " items where ", max_items_, " at most are allowed");
  classes_ = count_labels(truth, max_items_, class_size_);
  clusters_ = count_labels(predicted, max_items_, cluster_size_);

  std::int32_t first = 0;
  for (Index c = 0; c < classes_; ++c) {
    first_of_class_[c] = first;
    first += class_size_[c];
  }
  for (Index i = 0; i < n_; ++i) by_class_[first_of_class_[truth[i]]++] = i;

  // Items are visited class by class. Cells of earlier classes have indices below first_cell.
  std::fill_n(cell_of_cluster_.begin(), clusters_, -1);
  std::fill_n(majority_.begin(), clusters_, 0);
  cells_ = 0;
  Index first_cell = 0;
  for (Index position = 0; position < n_; ++position) {
    const std::int32_t item = by_class_[position];
    if (cells_ > 0 && truth[item] != cell_[cells_ - 1].true_class) first_cell = cells_;
    std::int32_t& cell = cell_of_cluster_[predicted[item]];
    if (cell < first_cell) {
      cell = cells_;
      cell_[cells_++] = {truth[item], predicted[item], 0};
    }
    majority_[predicted[item]] = std::max(majority_[predicted[item]], ++cell_[cell].items);
    cell_of_item_[item] = cell;
  }
}

Contingency::Pairs Contingency::pairs() const {
  std::int64_t both = 0, truth = 0, prediction = 0;
  for (Index c = 0; c < cells_; ++c) both += cell_[c].items * (cell_[c].items - 1);
  for (Index c = 0; c < classes_; ++c) truth += class_size_[c] * (class_size_[c] - 1);
  for (Index c = 0; c < clusters_; ++c) prediction += cluster_size_[c] * (cluster_size_[c] - 1);
  return {static_cast<double>(both), static_cast<double>(truth), static_cast<double>(prediction)};
}

double Contingency::fowlkes_mallows() const {
  const auto [both, truth, prediction] = pairs();
  return both == 0 ? 0 : std::sqrt(both / truth) * std::sqrt(both / prediction);
}

double Contingency::adjusted_rand() const {
  const auto [both, truth, prediction] = pairs();
  if (both == truth && both == prediction) return 1;
  const double all = static_cast<double>(n_) * (n_ - 1);
  const double missed = truth - both, wrong = prediction - both, apart = all - truth - wrong;
  return 2 * (both * apart - missed * wrong) / (truth * (missed + apart) + prediction * (wrong + apart));
}

double Contingency::normalized_mutual_info(NmiAverage average) const {
  const std::span class_sizes(class_size_.data(), classes_);
  const std::span cluster_sizes(cluster_size_.data(), clusters_);
  const bool one_class = groups(class_sizes) == 1, one_cluster = groups(cluster_sizes) == 1;
  if (one_class || one_cluster) return one_class && one_cluster ? 1 : 0;
  const double n = n_;
  double information = 0;
  for (Index c = 0; c < cells_; ++c) {
    const double items = cell_[c].items;
    information +=
        items / n *
        (std::log(n * items) - std::log(class_size_[cell_[c].true_class]) - std::log(cluster_size_[cell_[c].cluster]));
  }
  const double truth = entropy(class_sizes, n), prediction = entropy(cluster_sizes, n);
  const double mean = average == NmiAverage::arithmetic ? (truth + prediction) / 2 : std::sqrt(truth * prediction);
  return std::clamp(information / mean, 0.0, 1.0);
}

double Contingency::purity() const {
  const std::int64_t majority = std::accumulate(majority_.begin(), majority_.begin() + clusters_, std::int64_t{0});
  return static_cast<double>(majority) / n_;
}

void Contingency::fowlkes_mallows_individual(Singletons singletons, std::span<double> values) const {
  check(std::ssize(values) == n_, "[cluster metrics] ", values.size(), " values for ", n_, " items");
  for (Index i = 0; i < n_; ++i) {
    const Cell& cell = cell_[cell_of_item_[i]];
    const std::int64_t true_partners = class_size_[cell.true_class] - 1;
    const std::int64_t predicted_partners = cluster_size_[cell.cluster] - 1;
    if (true_partners == 0 && singletons == Singletons::skip)
      values[i] = std::numeric_limits<double>::quiet_NaN();
    else if (cell.items == 1)
      values[i] = 0;
    else
      values[i] = (cell.items - 1) / std::sqrt(static_cast<double>(true_partners) * predicted_partners);
  }
}

double fowlkes_mallows(Labels truth, Labels predicted) { return contingency(truth, predicted).fowlkes_mallows(); }

std::vector<double> fowlkes_mallows_individual(Labels truth, Labels predicted, Singletons singletons) {
  std::vector<double> values(truth.size());
  contingency(truth, predicted).fowlkes_mallows_individual(singletons, values);
  return values;
}

double normalized_mutual_info(Labels truth, Labels predicted, NmiAverage average) {
  return contingency(truth, predicted).normalized_mutual_info(average);
}

double purity(Labels truth, Labels predicted) { return contingency(truth, predicted).purity(); }

double adjusted_rand(Labels truth, Labels predicted) { return contingency(truth, predicted).adjusted_rand(); }

}  // namespace svnet::semantics
