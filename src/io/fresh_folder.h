#pragma once
#include <filesystem>

namespace svnet {

/// A folder that is filled under another name (its own with ".partial") and appears as a whole, or is removed.
class FreshFolder {
 public:
  /// Throws Error where `path` exists and is not an empty folder.
  explicit FreshFolder(const std::filesystem::path& path);
  ~FreshFolder();
  FreshFolder(const FreshFolder&) = delete;
  FreshFolder& operator=(const FreshFolder&) = delete;

  /// Where to write until keep().
  const std::filesystem::path& path() const { return partial_; }
  /// Gives the folder its name.
  void keep();

 private:
  std::filesystem::path path_, partial_;
};

}  // namespace svnet
