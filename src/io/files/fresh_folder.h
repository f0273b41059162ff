#pragma once
#include <atomic>
#include <filesystem>
#include <string_view>

namespace svnet::io {

/// A new folder that appears as a whole. It is filled under a temporary name (in the same parent folder, beginning with
/// a dot) and renamed by keep(); without keep() the destructor removes it. Several objects may make the same folder:
/// the first keep() succeeds, the others throw. A process that is killed leaves its temporary folder.
class FreshFolder {
 public:
  /// Creates the temporary folder and the parents of `path`; a symbolic link is followed. Throws Error if `path` exists
  /// and is not an empty folder, is the working directory, or is a mount point.
  explicit FreshFolder(const std::filesystem::path& path);
  ~FreshFolder();
  FreshFolder(const FreshFolder&) = delete;
  FreshFolder& operator=(const FreshFolder&) = delete;

  /// The temporary folder: files are written here.
  const std::filesystem::path& path() const { return partial_; }
  /// Writes a new file of the folder and the folders above it; `relative` is its path in this one. Thread-safe. Throws
  /// Error that names the file and gives the system's reason. The file is synced by keep(), with all others: to sync
  /// thousands of files one by one takes longer than to write them.
  void add(const std::filesystem::path& relative, std::string_view contents);
  /// Syncs the files that were added, and renames the temporary folder to its final path. Throws Error if something
  /// else has taken that path, or if the disk fails.
  void keep();

 private:
  std::filesystem::path name_, target_, partial_;
  std::atomic<bool> has_added_ = false;
};

}  // namespace svnet::io
