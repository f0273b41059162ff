#pragma once
#include <filesystem>

#include "io/files/descriptor.h"

namespace svnet::io {

/// A file that one process at a time may hold (flock). The kernel releases it when its holder ends, even if it is
/// killed. The file is created if there is none, its contents are not touched, and it is never removed.
class FileLock {
 public:
  /// Throws Error if the file cannot be opened. On file systems without locks nobody is kept away.
  explicit FileLock(const std::filesystem::path& path);

  /// False if another process holds the file.
  bool held() const { return held_; }

 private:
  Descriptor descriptor_;
  bool held_;
};

}  // namespace svnet::io
