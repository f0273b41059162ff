#pragma once
#include <filesystem>
#include <fstream>
#include <string_view>

namespace svnet::command {

/// A text file to which lines are appended, each after its local time: "2024-05-31 14:07:59 text". Not thread-safe.
class LogFile {
 public:
  /// Throws Error if the file cannot be opened.
  explicit LogFile(const std::filesystem::path& path);

  /// Appends one line and flushes it. Requires: no line break in `text`. Throws Error if the file cannot be written.
  void write(std::string_view text);

 private:
  std::filesystem::path path_;
  std::ofstream file_;
};

}  // namespace svnet::command
