#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/sha256_block.h"

namespace svnet {

/// SHA-256 (FIPS 180-4) of bytes that are added in pieces. Fingerprints of contents use it.
class Sha256 {
 public:
  Sha256& update(const void* data, std::size_t size);
  Sha256& update(std::string_view text) { return update(text.data(), text.size()); }
  /// Adds the length, then the text, so that ("ab", "c") and ("a", "bc") differ.
  Sha256& update_field(std::string_view text);
  /// The hash of all bytes that were added, as 64 lower-case hexadecimal digits.
  std::string hex() const;

 private:
  Sha256State state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<std::uint8_t, 64> buffer_{};
  std::uint64_t size_ = 0;
};

}  // namespace svnet
