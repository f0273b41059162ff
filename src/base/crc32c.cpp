#include "base/crc32c.h"

#include <array>
#include <bit>
#include <cstring>

namespace svnet {
namespace {

static_assert(std::endian::native == std::endian::little, "eight bytes are read as a little-endian number");

constexpr std::size_t kAtOnce = 8;

/// table[k][b] is what a byte b contributes that k more bytes follow (Kounavis and Berry, "A Systematic Approach to
/// Building High Performance Software-based CRC Generators", 2005).
constexpr auto kTables = [] {
  std::array<std::array<std::uint32_t, 256>, kAtOnce> tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t value = byte;
    for (int bit = 0; bit < 8; ++bit) value = (value >> 1) ^ ((value & 1) != 0 ? 0x82F63B78U : 0U);
    tables[0][byte] = value;
  }
  for (std::size_t k = 1; k < kAtOnce; ++k)
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t before = tables[k - 1][byte];
      tables[k][byte] = (before >> 8) ^ tables[0][before & 0xFFU];
    }
  return tables;
}();

}  // namespace

std::uint32_t crc32c(std::string_view bytes) {
  std::uint32_t crc = ~0U;
  while (bytes.size() >= kAtOnce) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data(), kAtOnce);
    word ^= crc;
    crc = 0;
    for (std::size_t i = 0; i < kAtOnce; ++i) crc ^= kTables[kAtOnce - 1 - i][(word >> (8 * i)) & 0xFFU];
    bytes.remove_prefix(kAtOnce);
  }
  for (const char byte : bytes) crc = (crc >> 8) ^ kTables[0][(crc ^ static_cast<unsigned char>(byte)) & 0xFFU];
  return ~crc;
}

}  // namespace svnet
