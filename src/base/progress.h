#pragma once
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "base/index.h"

namespace svnet {

/// Where the library reports what it does. By default nothing is reported; commands set these functions.
/// Set them before work starts. They are called from the thread that runs the work, never from pool threads.
struct Messages {
  /// One line, without the line break.
  std::function<void(std::string_view line)> line;
  /// `done` of `total` steps of `task` after `seconds`. total is 0 if it is unknown.
  std::function<void(std::string_view task, Index done, Index total, double seconds)> progress;
};

/// Reports the progress of one task to `messages`: at once, then at most ten times a second, and at the end if the
/// total is known.
class Progress {
 public:
  Progress(const Messages& messages, std::string task, Index total);
  /// Cheap: usually it only reads a clock.
  void update(Index done);
  double seconds() const;

 private:
  using Clock = std::chrono::steady_clock;
  const Messages& messages_;
  std::string task_;
  Index total_;
  Clock::time_point start_;
  std::optional<Clock::time_point> last_;
};

}  // namespace svnet
