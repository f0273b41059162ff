#pragma once
#include <vector>

#include "base/index.h"

namespace svnet::runtime {

/// A value stays in memory from the step that writes it to the last step that reads it.
struct Lifetime {
  Index size = 0;
  int first = 0, last = 0;  // indices of these steps
};

struct MemoryPlan {
  std::vector<Index> offsets;
  Index size = 0;  // of the whole arena
};

/// Places values so that no two overlap that are in memory during the same step: the largest first, each at the lowest
/// free offset. Offsets and sizes count floats and are multiples of 16. Each value also owns the 16 floats after it.
MemoryPlan plan_memory(const std::vector<Lifetime>& values);

}  // namespace svnet::runtime
