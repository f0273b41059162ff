#pragma once
#include <filesystem>
#include <string_view>

namespace svnet::io {

/// Owns the descriptor of an open file, or a negative number if it could not be opened.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor();
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

/// Throws Error that `path` cannot be written, for the reason errno = `error`.
[[noreturn]] void fail_to_write(const std::filesystem::path& path, int error);

/// Writes all of `contents`. Throws Error that names `path` if `file` is not open (errno says why) or a write fails.
void write_all(const std::filesystem::path& path, const Descriptor& file, std::string_view contents);

/// fsync, repeated if a signal interrupts it.
int synced(int descriptor);

}  // namespace svnet::io
