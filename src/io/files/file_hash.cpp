#include "io/files/file_hash.h"

#include <cerrno>
#include <fstream>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "base/sha256.h"

namespace svnet::io {

std::string file_sha256(const std::filesystem::path& path) {
  std::error_code ignored;
  check(!std::filesystem::is_directory(path, ignored), path.string(), ": cannot be read: it is a folder");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  check(file.is_open(), path.string(), ": cannot be read: ", std::generic_category().message(errno));
  Sha256 hash;
  std::vector<char> buffer(1 << 20);
  while (file.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || file.gcount() > 0)
    hash.update(buffer.data(), static_cast<std::size_t>(file.gcount()));
  check(!file.bad(), path.string(), ": cannot be read: ", std::generic_category().message(errno));
  return hash.hex();
}

}  // namespace svnet::io
