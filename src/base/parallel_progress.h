#pragma once
#include <algorithm>
#include <string>

#include "base/parallel.h"
#include "base/progress.h"

namespace svnet {

/// Calls work(i) for i in [0, count), in several threads, and reports the progress of the task from the calling thread.
template <class Work>
void for_each_with_progress(Parallel& parallel, const Messages& messages, const std::string& task, Index count,
                            const Work& work) {
  constexpr Index kBlock = 64;
  Progress progress(messages, task, count);
  for (Index block = 0; block < count; block += kBlock) {
    const Index size = std::min(kBlock, count - block);
    parallel.for_chunks(size, 1, [&](Index begin, Index end, int) {
      for (Index i = block + begin; i < block + end; ++i) work(i);
    });
    progress.update(block + size);
  }
}

}  // namespace svnet
