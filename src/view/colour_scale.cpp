#include "view/colour_scale.h"

#include <algorithm>
#include <array>

namespace svnet::view {

Colour scale_colour(double height) {
  constexpr std::array<Colour, 5> kScale{{{48, 18, 92}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};
  const double place = std::clamp(height, 0.0, 1.0) * (kScale.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), kScale.size() - 2);
  return mixed(kScale[below], kScale[below + 1], place - static_cast<double>(below));
}

}  // namespace svnet::view
