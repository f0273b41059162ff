#include "io/files/make_folder.h"

#include <system_error>

#include "base/error.h"

namespace svnet::io {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  check(!error || !std::filesystem::exists(folder), folder.string(), ": is not a folder; give the name of one");
  check(!error, folder.string(), ": cannot make this folder: ", error.message());
}

}  // namespace svnet::io
