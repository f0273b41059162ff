#pragma once
#include <string>
#include <string_view>

#include "base/index.h"

namespace svnet {

/// How far a task is: `done` of `total` steps after `seconds`; total 0 where it is unknown.
struct TaskState {
  std::string task;
  Index done = 0, total = 0;
  double seconds = 0;

  bool finished() const { return total > 0 && done >= total; }
};

/// "8.2 s", "3 min 20 s", "2 h 5 min"
std::string duration_text(double seconds);

/// "scores: 58 %, 830/1440, 122/s, 5.0 s left"
std::string plain_progress(const TaskState& state);

/// "scores: 1440 in 11.8 s", or what was reached of a task that did not end.
std::string final_progress(const TaskState& state);

/// The same with a bar, cut to less than `columns`: "scores  [######----]  58 %, 830/1440, …"
std::string progress_bar(const TaskState& state, int columns);

}  // namespace svnet
