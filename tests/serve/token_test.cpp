#include "serve/token.h"

#include <catch2/catch.hpp>

#include "base/error.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::serve;

TEST_CASE("a token is one line") {
  const TemporaryFolder folder;
  const std::string token = "0123456789abcdefABCDEF-._~+/=";
  for (const char* end : {"", "\n", "\r\n"}) CHECK(read_token(folder.write("token", token + end)) == token);
  CHECK(read_token(folder.write("token", std::string(512, 'a') + "\n")).size() == 512);
}

TEST_CASE("what is no token is refused without being shown") {
  const TemporaryFolder folder;
  for (const std::string& wrong : {std::string(), std::string("short"), std::string(513, 'a'), std::string(600, 'a'),
                                   std::string("two words 0123456789"), std::string("0123456789abcdef\n\n"),
                                   std::string("0123456789abcdef\nsecond"), std::string("0123456789abcde%20")}) {
    const auto file = folder.write("token", wrong);
    CAPTURE(wrong);
    try {
      read_token(file);
      FAIL("it was taken");
    } catch (const Error& error) {
      CHECK_THAT(error.what(), Catch::StartsWith(file.string() + ": is no token"));
      if (wrong.size() > 8) CHECK_THAT(error.what(), !Catch::Contains(wrong));
    }
  }
  CHECK_THROWS_WITH(read_token(folder.path() / "none"), Catch::Contains("cannot be read"));
}

TEST_CASE("tokens are equal or not") {
  CHECK(equal_in_constant_time("", ""));
  CHECK(equal_in_constant_time("abc", "abc"));
  for (const char* other : {"", "ab", "abd", "abcd", "Abc"}) CHECK_FALSE(equal_in_constant_time(other, "abc"));
}
