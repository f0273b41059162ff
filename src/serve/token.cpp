#include "serve/token.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

#include "base/error.h"
#include "base/sha256.h"

namespace svnet::serve {
namespace {

constexpr std::size_t kShortestToken = 16, kLongestToken = 512;

bool is_token_character(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ||
         std::string_view("-._~+/=").find(c) != std::string_view::npos;
}

}  // namespace

std::string read_token(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  check(stream.is_open(), file.string(), ": cannot be read, expected a token");
  std::array<char, kLongestToken + 3> bytes{};
  stream.read(bytes.data(), bytes.size());
  std::string_view token(bytes.data(), static_cast<std::size_t>(stream.gcount()));
  if (token.ends_with('\n')) token.remove_suffix(1);
  if (token.ends_with('\r')) token.remove_suffix(1);
  check(
      token.size() >= kShortestToken && token.size() <= kLongestToken && std::ranges::all_of(token, is_token_character),
      file.string(), ": is no token, expected one line of ", kShortestToken, " to ", kLongestToken,
      " letters, digits and -._~+/=; `openssl rand -hex 32` makes one");
  return std::string(token);
}

bool equal_in_constant_time(const std::string& given, const std::string& secret) {
  // Hashes have one length, and a client cannot choose where they differ.
  const std::string a = Sha256().update(given).hex(), b = Sha256().update(secret).hex();
  unsigned different = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    different |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return different == 0;
}

}  // namespace svnet::serve
