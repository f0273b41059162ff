#include "base/sha256.h"

#include <catch2/catch.hpp>

using svnet::Sha256;

TEST_CASE("SHA-256 gives FIPS 180-4's known answers") {
  CHECK(Sha256().hex() == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(Sha256().update("abc").hex() == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(Sha256().update("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq").hex() ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST_CASE("SHA-256 does not depend on how the bytes are split") {
  const std::string text(1000, 'a');
  for (std::size_t cut : {1, 63, 64, 65, 128, 999}) {
    Sha256 pieces;
    for (std::size_t at = 0; at < text.size(); at += cut) pieces.update(std::string_view(text).substr(at, cut));
    CHECK(pieces.hex() == Sha256().update(text).hex());
  }
}

TEST_CASE("a hash of fields depends on where each field ends") {
  CHECK(Sha256().update_field("ab").update_field("c").hex() != Sha256().update_field("a").update_field("bc").hex());
}

TEST_CASE("the SHA extensions give the bits of the plain rounds") {
  std::array<std::uint8_t, 64> block{};
  svnet::Sha256State fast{1, 2, 3, 4, 5, 6, 7, 8}, plain = fast;
  std::uint32_t random = 1;
  for (int i = 0; i < 1000; ++i) {
    for (auto& byte : block) byte = static_cast<std::uint8_t>((random = 1664525 * random + 1013904223) >> 24);
    svnet::sha256_block(fast, block.data());
    svnet::sha256_block_reference(plain, block.data());
    REQUIRE(fast == plain);
  }
}
