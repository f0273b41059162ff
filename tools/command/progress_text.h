#pragma once
#include <string>
#include <string_view>

#include "base/index.h"

namespace svnet::command {

/// `done` of `total` steps of a task after `seconds`. total 0: unknown.
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

/// "scores: 1440 in 11.8 s", or "scores: 830 of 1440 in 6.8 s" if the task stopped early.
std::string final_progress(const TaskState& state);

/// plain_progress with a bar, shorter than `columns`: "scores  [######----]  58 %, 830/1440, …"
std::string progress_bar(const TaskState& state, int columns);

}  // namespace svnet::command
