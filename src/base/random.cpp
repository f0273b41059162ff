#include "base/random.h"

#include <cmath>
#include <numbers>

namespace svnet {

namespace {

using Counter = std::array<std::uint32_t, 4>;
using Key = std::array<std::uint32_t, 2>;

inline Counter round(const Counter& c, const Key& k) {
  const std::uint64_t p0 = std::uint64_t{0xD2511F53} * c[0];
  const std::uint64_t p1 = std::uint64_t{0xCD9E8D57} * c[2];
  return {static_cast<std::uint32_t>(p1 >> 32) ^ c[1] ^ k[0], static_cast<std::uint32_t>(p1),
          static_cast<std::uint32_t>(p0 >> 32) ^ c[3] ^ k[1], static_cast<std::uint32_t>(p0)};
}

inline Key next(const Key& k) { return {k[0] + 0x9E3779B9, k[1] + 0xBB67AE85}; }

}  // namespace

std::array<std::uint32_t, 4> philox4x32(Counter c, Key k) {
  for (int i = 0; i < 10; ++i, k = next(k)) c = round(c, k);
  return c;
}

double RandomStream::normal() {
  const double u = uniform();
  const double v = uniform();
  return std::sqrt(-2.0 * std::log(1.0 - u)) * std::cos(2.0 * std::numbers::pi * v);
}

}  // namespace svnet
