#pragma once
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "base/index.h"

namespace svnet {

/// Where the library says what it is doing. The default sinks discard everything; commands set their own.
/// Set them before work starts: they are called from the thread that runs the work, never from pool threads.
struct Messages {
  /// One whole line, without its end.
  std::function<void(std::string_view line)> line;
  /// `done` of `total` steps of `task` after `seconds`; total 0 where it is unknown.
  std::function<void(std::string_view task, Index done, Index total, double seconds)> progress;
};

/// Progress of one task, reported to `messages` at once, then at most ten times a second, and at the end of a known
/// total.
class Progress {
 public:
  Progress(const Messages& messages, std::string task, Index total);
  /// Call as often as is handy: a clock is read, little else happens.
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
