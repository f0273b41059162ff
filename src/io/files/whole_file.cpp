#include "io/files/whole_file.h"

#include <cerrno>
#include <fstream>
#include <system_error>

#include "base/error.h"

namespace svnet::io {

std::string whole_file(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  const std::string name = path.string();
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  check(!fs::exists(status) || fs::is_regular_file(status), name, ": is not a regular file");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  const auto reason = [] { return std::generic_category().message(errno != 0 ? errno : EIO); };
  check(file.is_open(), name, ": cannot be read: ", reason());
  const std::uintmax_t size = fs::file_size(path, error);
  check(!error, name, ": cannot be read: ", error.message());
  std::string contents(size, '\0');
  file.read(contents.data(), static_cast<std::streamsize>(size));
  check(static_cast<std::uintmax_t>(file.gcount()) == size, name, ": cannot be read: ", reason());
  return contents;
}

}  // namespace svnet::io
