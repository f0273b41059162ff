#pragma once
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "base/index.h"
#include "image/image.h"

namespace svnet::io {

/// A file of events that TensorBoard reads while it grows: records as in TensorFlow's record_writer.cc, each an Event
/// of event.proto. It is the one file that is not written as a whole: after a crash its last record may be incomplete,
/// and readers skip it.
class EventFile {
 public:
  /// Creates events.out.tfevents.<seconds since 1970>.<writer> in the folder, and removes files of the same writer.
  /// Throws Error that names the file.
  EventFile(const std::filesystem::path& folder, const std::string& writer);

  /// The value of `tag` ("loss") at a step. Throws Error that names the file if it cannot be written.
  void add_scalar(std::string_view tag, Index step, double value);
  /// An image of `tag` at a step, as PNG.
  void add_image(std::string_view tag, Index step, const Image& image);

  const std::filesystem::path& path() const { return path_; }

 private:
  void add(std::string_view event);

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace svnet::io
