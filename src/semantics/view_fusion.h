#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "base/enum_names.h"
#include "base/error.h"
#include "base/index.h"

namespace svnet::semantics {

/// How the features of an item's views become features of the item.
///   mean         their average
///   concatenate  one after the other; requires as many views of every item
enum class ViewFusion { mean, concatenate };
constexpr auto enum_table(ViewFusion) {
  return std::to_array<EnumName<ViewFusion>>({{ViewFusion::mean, "mean"}, {ViewFusion::concatenate, "concatenate"}});
}

/// Features of items (items, D), or (items, V D) if V views are concatenated. `features` is (sum of views, dimension):
/// the views of the first item, then those of the second one, and so on; views[i] is the number of item i. Throws Error
/// if an item has no views, sizes do not fit, or numbers of views differ and they are concatenated.
inline std::vector<float> fused_views(ViewFusion fusion, std::span<const float> features, Index dimension,
                                      std::span<const Index> views) {
  Index rows = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    check(views[i] >= 1, "[view_fusion] item ", i, " has no views");
    check(fusion == ViewFusion::mean || views[i] == views[0], "[view_fusion] item ", i, " has ", views[i],
          " views, item 0 has ", views[0], "; concatenate needs as many views of every item, mean takes any");
    rows += views[i];
  }
  check(dimension >= 1 && static_cast<Index>(features.size()) == rows * dimension, "[view_fusion] ", features.size(),
        " features are not ", rows, " x ", dimension);
  if (fusion == ViewFusion::concatenate) return {features.begin(), features.end()};
  std::vector<float> result;
  std::vector<double> sum(static_cast<std::size_t>(dimension));
  const float* row = features.data();
  for (const Index count : views) {
    std::ranges::fill(sum, 0.0);
    for (Index v = 0; v < count; ++v)
      for (double& value : sum) value += *row++;
    for (const double value : sum) result.push_back(static_cast<float>(value / static_cast<double>(count)));
  }
  return result;
}

}  // namespace svnet::semantics
