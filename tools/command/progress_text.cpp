#include "command/progress_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace svnet::command {
namespace {

template <class... Values>
std::string printed(const char* format, Values... values) {
  char text[64];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

/// ", 122/s", or ", 2.3 s each" if the rate is below 1/s.
std::string rate_text(const TaskState& state) {
  if (state.done <= 0 || state.seconds <= 0) return "";
  const double rate = state.done / state.seconds;
  if (rate < 1) return ", " + duration_text(1 / rate) + " each";
  return printed(rate < 99.5 ? ", %.3g/s" : ", %.0f/s", rate);
}

std::string counts(const TaskState& state) {
  if (state.total == 0) return std::to_string(state.done) + rate_text(state);
  const double share = static_cast<double>(state.done) / state.total;
  std::string text = printed("%.0f %%, ", std::floor(100 * share)) + std::to_string(state.done) + "/" +
                     std::to_string(state.total) + rate_text(state);
  if (state.done > 0) text += ", " + duration_text(state.seconds * (1 / share - 1)) + " left";
  return text;
}

}  // namespace

std::string duration_text(double seconds) {
  if (seconds < 59.95) return printed("%.1f s", seconds);
  const long whole = std::lround(seconds);
  if (whole < 3600) return printed("%ld min %ld s", whole / 60, whole % 60);
  return printed("%ld h %ld min", whole / 3600, whole % 3600 / 60);
}

std::string plain_progress(const TaskState& state) { return state.task + ": " + counts(state); }

std::string final_progress(const TaskState& state) {
  const bool stopped_early = state.total > 0 && !state.finished();
  return state.task + ": " + std::to_string(state.done) + (stopped_early ? " of " + std::to_string(state.total) : "") +
         " in " + duration_text(state.seconds);
}

std::string progress_bar(const TaskState& state, int columns) {
  constexpr int kBarColumns = 24;
  std::string line = state.task + "  ";
  if (state.total > 0) {
    const Index full = std::clamp<Index>(state.done, 0, state.total) * kBarColumns / state.total;
    line += "[" + std::string(full, '#') + std::string(kBarColumns - full, '-') + "]  ";
  }
  line += counts(state);
  std::size_t length = std::min<std::size_t>(line.size(), std::max(columns - 1, 0));
  while (length > 0 && length < line.size() && (line[length] & 0xC0) == 0x80) --length;  // do not cut a UTF-8 character
  return line.substr(0, length);
}

}  // namespace svnet::command
