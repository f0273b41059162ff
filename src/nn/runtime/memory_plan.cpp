#include "nn/runtime/memory_plan.h"

#include <algorithm>
#include <numeric>

namespace svnet::runtime {

MemoryPlan plan_memory(const std::vector<Lifetime>& values) {
  // A kernel may read one vector past the end of a value. No other thread may be writing there.
  const auto rounded = [&](std::size_t i) { return values[i].size == 0 ? 0 : (values[i].size + 15) / 16 * 16 + 16; };
  std::vector<std::size_t> order(values.size()), placed;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a].size > values[b].size; });
  MemoryPlan plan{.offsets = std::vector<Index>(values.size(), 0)};
  for (std::size_t i : order) {
    // `placed` is sorted by offset: take the first gap that is large enough.
    Index offset = 0;
    for (std::size_t other : placed) {
      if (values[other].last < values[i].first || values[i].last < values[other].first) continue;
      if (plan.offsets[other] >= offset + rounded(i)) break;
      offset = std::max(offset, plan.offsets[other] + rounded(other));
    }
    plan.offsets[i] = offset;
    plan.size = std::max(plan.size, offset + rounded(i));
    placed.insert(std::upper_bound(placed.begin(), placed.end(), i,
                                   [&](auto a, auto b) { return plan.offsets[a] < plan.offsets[b]; }),
                  i);
  }
  return plan;
}

}  // namespace svnet::runtime
