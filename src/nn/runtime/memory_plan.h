#pragma once
#include <vector>

#include "base/index.h"

namespace svnet::runtime {

/// A value that must stay in memory from the step that writes it to the last that reads it.
struct Lifetime {
  Index size = 0;
  int first = 0, last = 0;  // steps, both included
};

struct MemoryPlan {
  std::vector<Index> offsets;
  Index size = 0;  // of the whole arena
};

/// Places values so that no two that live at once overlap: largest first, each at the lowest free offset. Offsets and
/// sizes are multiples of 16 numbers, and 16 numbers behind each value belong to it.
MemoryPlan plan_memory(const std::vector<Lifetime>& values);

}  // namespace svnet::runtime
