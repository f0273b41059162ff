#pragma once
#include <filesystem>
#include <string>

namespace svnet::io {

/// A new folder in that of the system for temporary files ($TMPDIR, or /tmp). The destructor removes it with its
/// contents. A process that is killed leaves it.
class ScratchFolder {
 public:
  /// The folder's name begins with `prefix`. Throws Error if it cannot be made.
  explicit ScratchFolder(const std::string& prefix);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace svnet::io
