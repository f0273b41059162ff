#pragma once
#include <filesystem>

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
  /// Renames the temporary folder to its final path. Throws Error if something else has taken that path.
  void keep();

 private:
  std::filesystem::path name_, target_, partial_;
};

}  // namespace svnet::io
