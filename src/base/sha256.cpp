#include "base/sha256.h"

#include <algorithm>
#include <cstring>

namespace svnet {

Sha256& Sha256::update(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  while (size > 0) {
    const std::size_t used = size_ % 64;
    if (used == 0 && size >= 64) {
      sha256_block(state_, bytes);
      bytes += 64, size -= 64, size_ += 64;
      continue;
    }
    const std::size_t n = std::min(size, 64 - used);
    std::memcpy(buffer_.data() + used, bytes, n);
    bytes += n, size -= n, size_ += n;
    if (size_ % 64 == 0) sha256_block(state_, buffer_.data());
  }
  return *this;
}

Sha256& Sha256::update_field(std::string_view text) {
  const std::uint64_t size = text.size();
  return update(&size, sizeof size).update(text);
}

std::string Sha256::hex() const {
  Sha256 last = *this;
  const std::uint64_t bits = size_ * 8;
  const std::uint8_t one = 0x80, zero = 0;
  last.update(&one, 1);
  while (last.size_ % 64 != 56) last.update(&zero, 1);
  for (int i = 7; i >= 0; --i) {
    const auto byte = static_cast<std::uint8_t>(bits >> (8 * i));
    last.update(&byte, 1);
  }
  std::string text;
  for (std::uint32_t word : last.state_)
    for (int shift = 28; shift >= 0; shift -= 4) text += "0123456789abcdef"[(word >> shift) & 15];
  return text;
}

}  // namespace svnet
