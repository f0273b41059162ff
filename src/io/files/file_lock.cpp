#include "io/files/file_lock.h"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>

#include "base/error.h"

namespace svnet::io {
namespace {

bool lock(int descriptor) {
  while (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EINTR) continue;
    return errno != EWOULDBLOCK;
  }
  return true;
}

}  // namespace

FileLock::FileLock(const std::filesystem::path& path)
    : descriptor_(::open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666)), held_(false) {
  const int error = errno;
  check(descriptor_.number() >= 0, path.string(), ": cannot be opened: ", std::generic_category().message(error));
  held_ = lock(descriptor_.number());
}

}  // namespace svnet::io
