#pragma once
#include <cmath>

namespace svnet::test {

/// x with 8 significant bits, ties to even.
inline double rounded_to_bf16(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(std::nearbyint(std::ldexp(mantissa, 8)), exponent - 8);
}

}  // namespace svnet::test
