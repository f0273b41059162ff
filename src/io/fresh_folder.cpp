#include "io/fresh_folder.h"

#include <system_error>

#include "base/error.h"

namespace svnet {

namespace fs = std::filesystem;

FreshFolder::FreshFolder(const fs::path& path)
    : path_(path.has_filename() ? path : path.parent_path()), partial_(path_) {
  std::error_code error;
  check(!fs::exists(path_, error) || fs::is_empty(path_, error), path_.string(),
        ": exists already, remove it or choose another folder");
  partial_ += ".partial";
  fs::remove_all(partial_, error);
  fs::create_directories(partial_, error);
  check(!error, path_.string(), ": cannot be made: ", error.message());
}

FreshFolder::~FreshFolder() {
  std::error_code ignored;
  fs::remove_all(partial_, ignored);
}

void FreshFolder::keep() {
  std::error_code error;
  fs::rename(partial_, path_, error);
  check(!error, path_.string(), ": cannot be made: ", error.message());
}

}  // namespace svnet
