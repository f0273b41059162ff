#pragma once
#include <filesystem>

namespace svnet {

/// A folder that is filled under another name and appears as a whole, or is removed. The other name begins with a dot,
/// lies beside the folder and belongs to this object alone: whatever else is there is left as it is, and of several
/// that make the same folder the first to finish has it. A process that is killed leaves its part behind.
class FreshFolder {
 public:
  /// A link leads to the folder that it names; folders above are made. Throws Error where keep() could not give the
  /// folder its name: `path` exists and is not an empty folder, is where the process runs, or is a mount point.
  explicit FreshFolder(const std::filesystem::path& path);
  ~FreshFolder();
  FreshFolder(const FreshFolder&) = delete;
  FreshFolder& operator=(const FreshFolder&) = delete;

  /// Where to write until keep().
  const std::filesystem::path& path() const { return partial_; }
  /// Gives the folder its name. Throws Error where something has come to be there meanwhile.
  void keep();

 private:
  std::filesystem::path name_, target_, partial_;
};

}  // namespace svnet
