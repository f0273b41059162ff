#pragma once
#include <chrono>
#include <filesystem>
#include <optional>
#include <string_view>

#include "base/progress.h"
#include "command/log_file.h"
#include "command/progress_text.h"

namespace svnet::command {

/// The output of a command. Results go to stdout; messages, progress and errors go to stderr. On a terminal, progress
/// is a bar that is redrawn. Elsewhere it is plain lines without control characters: at most one every ten seconds, and
/// one at the end of a task. The log file, if any, receives every line, progress and error with its time; no results.
/// Not thread-safe.
class Console {
 public:
  /// What is printed. normal: everything. quiet: results and errors. errors_only: errors, and no log file is written.
  enum class Verbosity { normal, quiet, errors_only };
  /// `terminal`: whether stderr is a terminal that understands ANSI sequences.
  Console(Verbosity verbosity, bool terminal);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  /// The callbacks that functions of the library take. They are valid while the console exists. The one for progress
  /// throws Interrupted after SIGINT, SIGTERM or SIGHUP.
  const Messages& messages() const { return messages_; }

  /// Prints a message of one line.
  void line(std::string_view text);
  /// Prints one or more lines on stdout. Adds the last line break if it is missing.
  void result(std::string_view text);
  /// Prints an error of one line on stderr, at every verbosity.
  void error(std::string_view text);
  /// Appends all later lines to `file` too. Creates its folder. Throws Error if that fails.
  void log_to(const std::filesystem::path& file);
  /// Prints the last line of the task in progress, if there is one.
  void end_task();

 private:
  using Clock = std::chrono::steady_clock;

  void progress(TaskState state);
  void print(std::string_view text);
  void erase_bar();

  Verbosity verbosity_;
  bool terminal_;
  bool bar_drawn_ = false;
  std::optional<TaskState> task_;  // in progress
  Clock::time_point last_plain_;
  std::optional<LogFile> log_file_;
  Messages messages_;
};

/// Whether stderr is a terminal that understands ANSI sequences.
bool stderr_is_terminal();

}  // namespace svnet::command
