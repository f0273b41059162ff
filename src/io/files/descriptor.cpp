#include "io/files/descriptor.h"

#include <cerrno>
#include <system_error>

#include <unistd.h>

#include "base/error.h"

namespace svnet::io {

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

void fail_to_write(const std::filesystem::path& path, int error) {
  fail(path.string(), ": cannot be written: ", std::generic_category().message(error));
}

void write_all(const std::filesystem::path& path, const Descriptor& file, std::string_view contents) {
  if (file.number() < 0) fail_to_write(path, errno);
  while (!contents.empty()) {
    const ssize_t written = ::write(file.number(), contents.data(), contents.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_to_write(path, errno);
    contents.remove_prefix(static_cast<std::size_t>(written));
  }
}

int synced(int descriptor) {
  int result;
  do result = ::fsync(descriptor);
  while (result != 0 && errno == EINTR);
  return result;
}

}  // namespace svnet::io
