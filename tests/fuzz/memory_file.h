#pragma once
#include <cerrno>
#include <string>
#include <system_error>

#include <sys/mman.h>
#include <unistd.h>

#include "fuzz_target.h"

namespace svnet::fuzz {

/// A file in memory, for readers that take a path.
class MemoryFile {
 public:
  explicit MemoryFile(Bytes contents) : descriptor_(::memfd_create("input", MFD_CLOEXEC)) {
    const bool is_written = descriptor_ >= 0 && ::write(descriptor_, contents.data(), contents.size()) ==
                                                    static_cast<ssize_t>(contents.size());
    if (!is_written) throw std::system_error(errno, std::generic_category(), "memfd");
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

}  // namespace svnet::fuzz
