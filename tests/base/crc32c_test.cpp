#include "base/crc32c.h"

#include <catch2/catch.hpp>
#include <string>

using svnet::crc32c;

TEST_CASE("CRC-32C has the known answers of RFC 3720") {
  CHECK(crc32c("") == 0);
  CHECK(crc32c("123456789") == 0xE3069283U);
  CHECK(crc32c(std::string(32, '\0')) == 0x8A9136AAU);
  CHECK(crc32c(std::string(32, '\xff')) == 0x62A8AB43U);
}

TEST_CASE("CRC-32C at every length and offset is that of its definition") {
  std::string bytes;
  for (int i = 0; i < 100; ++i) bytes += static_cast<char>(i * 37 + 11);
  for (std::size_t offset = 0; offset < 9; ++offset)
    for (std::size_t length = 0; length < 70; ++length) {
      const std::string part = bytes.substr(offset, length);
      std::uint32_t crc = ~0U;
      for (const char byte : part) {
        crc ^= static_cast<unsigned char>(byte);
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0x82F63B78U : 0U);
      }
      REQUIRE(crc32c(part) == ~crc);
    }
}
