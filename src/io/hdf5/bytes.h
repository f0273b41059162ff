#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include "base/error.h"

namespace svnet::io::hdf5 {

/// Reads bytes of a file from front to back. Throws Error with `message` when a read would pass the end. `message` must
/// outlive this object.
class Bytes {
 public:
  Bytes(std::span<const char> bytes, std::string_view message) : bytes_(bytes), message_(message) {}

  std::uint64_t size() const { return bytes_.size(); }
  [[noreturn]] void refuse() const { fail(message_); }

  /// The next `size` bytes (1 to 8) as a little-endian number.
  std::uint64_t number(std::uint64_t size) {
    std::uint64_t value = 0;
    const std::span<const char> digits = take(size);
    for (std::uint64_t i = size; i-- > 0;) value = value << 8 | static_cast<unsigned char>(digits[i]);
    return value;
  }
  void skip(std::uint64_t size) { take(size); }
  Bytes part(std::uint64_t size) { return {take(size), message_}; }
  std::span<const char> take(std::uint64_t size) {
    if (size > bytes_.size()) refuse();
    const std::span<const char> front = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return front;
  }

 private:
  std::span<const char> bytes_;
  std::string_view message_;
};

}  // namespace svnet::io::hdf5
