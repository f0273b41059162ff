#include "base/bf16.h"

#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "base/rounded_to_bf16.h"

using namespace svnet;
using svnet::test::rounded_to_bf16;

TEST_CASE("floats are rounded to the nearest bf16, ties to even") {
  RandomStream random(1, Stream::weights);
  for (int i = 0; i < 1000; ++i) {
    const auto x = static_cast<float>(static_cast<std::int32_t>(random.bits32()));
    REQUIRE(f32_of_bf16(bf16_bits(x)) == static_cast<float>(rounded_to_bf16(x)));
  }
  CHECK(bf16_bits(0x1.01p0f) == bf16_bits(1.0f));
  CHECK(bf16_bits(0x1.03p0f) == bf16_bits(0x1.04p0f));
  CHECK(bf16_bits(-std::numeric_limits<float>::infinity()) == 0xff80);
  CHECK(bf16_bits(std::numeric_limits<float>::max()) == 0x7f80);
  CHECK(std::isnan(f32_of_bf16(bf16_bits(std::bit_cast<float>(0x7f800001)))));
}

TEST_CASE("every bf16 keeps its bits as a float, and as bytes at any address") {
  for (std::uint32_t bits = 0; bits < 0x10000; ++bits) {
    const float x = f32_of_bf16(static_cast<std::uint16_t>(bits));
    if (!std::isnan(x)) REQUIRE(bf16_bits(x) == bits);
  }
  const std::array<float, 3> values{1, -2.5f, 0x1.04p-100f};
  std::vector<std::byte> bytes = bf16_bytes(values);
  REQUIRE(bytes.size() == 6);
  CHECK(bytes[0] == std::byte{0x80});
  CHECK(bytes[1] == std::byte{0x3f});
  bytes.insert(bytes.begin(), std::byte{0});
  std::array<float, 3> read{};
  read_bf16(std::span(bytes).subspan(1), read);
  CHECK(read == values);
}
