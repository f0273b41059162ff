#include "command/console.h"

#include <algorithm>
#include <iostream>

#include <sys/ioctl.h>
#include <unistd.h>

#include "base/environment.h"
#include "base/error.h"
#include "base/text.h"
#include "command/interrupt.h"
#include "io/files/make_folder.h"

namespace svnet::command {
namespace {

int terminal_columns() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

Console::Console(Verbosity verbosity, bool terminal) : verbosity_(verbosity), terminal_(terminal) {
  messages_.line = [this](std::string_view text) { line(text); };
  messages_.progress = [this](std::string_view task, Index done, Index total, double seconds) {
    throw_if_interrupted();
    progress({printable(task), done, total, seconds});
  };
}

Console::~Console() { erase_bar(); }

void Console::line(std::string_view text) { print(printable(text)); }

void Console::result(std::string_view text) {
  if (verbosity_ == Verbosity::errors_only) return;
  erase_bar();
  std::size_t start = 0, end;
  do {  // line by line, because printable replaces line breaks
    end = std::min(text.find('\n', start), text.size());
    std::cout << printable(text.substr(start, end - start)) << '\n';
    start = end + 1;
  } while (end < text.size());
}

void Console::error(std::string_view text) {
  const std::string clean = printable(text);
  erase_bar();
  std::cerr << clean << std::endl;
  try {
    if (log_file_) log_file_->write(clean);
  } catch (const Error&) {
    log_file_.reset();  // `text` may be the message that the disk is full
  }
}

void Console::log_to(const std::filesystem::path& file) {
  if (verbosity_ == Verbosity::errors_only) return;
  const std::filesystem::path folder = file.parent_path();
  if (!folder.empty()) io::make_folder(folder);
  log_file_.emplace(file);
}

void Console::end_task() {
  if (!task_) return;
  const std::string text = final_progress(*task_);
  task_.reset();
  print(text);
}

void Console::progress(TaskState state) {
  const auto now = Clock::now();
  if (task_ && task_->task != state.task) end_task();
  if (!task_) last_plain_ = now;
  task_ = std::move(state);
  if (task_->finished()) return end_task();
  if (terminal_ && verbosity_ == Verbosity::normal) {
    std::cerr << '\r' << progress_bar(*task_, terminal_columns()) << "\x1b[K" << std::flush;
    bar_drawn_ = true;
  }
  if (now - last_plain_ < std::chrono::seconds(10)) return;
  last_plain_ = now;
  const std::string text = plain_progress(*task_);
  if (!terminal_) return print(text);
  if (log_file_) log_file_->write(text);
}

void Console::print(std::string_view text) {
  if (verbosity_ == Verbosity::normal) {
    erase_bar();
    std::cerr << text << std::endl;
  }
  if (log_file_) log_file_->write(text);
}

void Console::erase_bar() {
  if (bar_drawn_) std::cerr << "\r\x1b[K" << std::flush;
  bar_drawn_ = false;
}

bool stderr_is_terminal() {
  const std::string kind = environment_variable("TERM");
  return ::isatty(STDERR_FILENO) == 1 && !kind.empty() && kind != "dumb";
}

}  // namespace svnet::command
