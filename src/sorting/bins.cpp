#include "sorting/bins.h"

#include <algorithm>
#include <map>

#include "base/error.h"

namespace svnet::sorting {
namespace {

/// The category that a bin stands for. `count`: of each category in it.
std::int32_t category_of_bin(std::int32_t bin, std::span<const std::int32_t> bins,
                             std::span<const std::int32_t> categories,
                             const std::map<std::int32_t, std::int32_t>& count) {
  std::int32_t best = -1;
  for (std::size_t i = 0; i < bins.size(); ++i)
    if (bins[i] == bin && (best < 0 || count.at(categories[i]) > count.at(best))) best = categories[i];
  return best;
}

}  // namespace

std::vector<bool> in_wrong_bin(std::span<const std::int32_t> bins, std::span<const std::int32_t> categories) {
  check(bins.size() == categories.size(), "[bins] ", bins.size(), " bins of ", categories.size(), " objects");
  std::map<std::int32_t, std::map<std::int32_t, std::int32_t>> count;  // by bin and category
  std::map<std::int32_t, std::int32_t> most;                           // of a category in one bin
  for (std::size_t i = 0; i < bins.size(); ++i)
    most[categories[i]] = std::max(most[categories[i]], ++count[bins[i]][categories[i]]);
  std::map<std::int32_t, std::int32_t> right_bin;  // by category
  for (const auto& [bin, in_bin] : count) {
    const std::int32_t category = category_of_bin(bin, bins, categories, in_bin);
    if (in_bin.at(category) == most[category]) right_bin.emplace(category, bin);
  }
  std::vector<bool> wrong;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    const auto right = right_bin.find(categories[i]);
    wrong.push_back(right == right_bin.end() || right->second != bins[i]);
  }
  return wrong;
}

}  // namespace svnet::sorting
