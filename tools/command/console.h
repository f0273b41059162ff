#pragma once
#include <chrono>
#include <filesystem>
#include <optional>
#include <string_view>

#include "base/progress.h"
#include "command/log_file.h"
#include "command/progress_text.h"

namespace svnet {

/// Where a command speaks: results on stdout; lines and progress on stderr, as a bar that is redrawn on a terminal, as
/// timed lines without control characters elsewhere (at most one in ten seconds, and one at a task's end). Quiet leaves
/// results and errors, mute leaves errors and writes no log file. A log file gets every line with its time. One thread
/// at a time.
class Console {
 public:
  enum class Verbosity { normal, quiet, errors_only };
  /// `terminal`: stderr is a terminal that understands ANSI.
  Console(Verbosity verbosity, bool terminal);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  /// What the library's functions take; valid as long as the console. Reporting progress throws Interrupted after
  /// SIGINT or SIGTERM.
  const Messages& messages() const { return messages_; }

  /// One line of the log.
  void line(std::string_view text);
  /// Lines of text on stdout, the last one with its end too.
  void result(std::string_view text);
  /// One line on stderr, quiet or not.
  void error(std::string_view text);
  /// From now on lines are appended to `file` too; its folder is made.
  void log_to(const std::filesystem::path& file);
  /// Says where the task in progress ended, if one is.
  void end_task();

 private:
  using Clock = std::chrono::steady_clock;

  void progress(TaskState state);
  void print(std::string_view text);
  void erase_bar();

  Verbosity verbosity_;
  bool terminal_;
  bool bar_drawn_ = false;
  std::optional<TaskState> task_;  ///< in progress
  Clock::time_point last_plain_;
  std::optional<LogFile> log_file_;
  Messages messages_;
};

/// Whether stderr is a terminal that understands ANSI.
bool stderr_is_terminal();

}  // namespace svnet
