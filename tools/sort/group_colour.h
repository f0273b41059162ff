#pragma once
#include <array>
#include <cstdint>

#include "base/index.h"

namespace svnet {

/// Ten colours (red, green, blue) that differ for the colour-blind too (Petroff, arXiv 2107.02270); later groups begin
/// again.
inline std::array<std::uint8_t, 3> group_colour(Index group) {
  constexpr std::array<std::array<std::uint8_t, 3>, 10> kColours{{{63, 144, 218},
                                                                  {255, 169, 14},
                                                                  {189, 31, 1},
                                                                  {131, 45, 182},
                                                                  {148, 164, 162},
                                                                  {169, 107, 89},
                                                                  {231, 99, 0},
                                                                  {185, 172, 112},
                                                                  {113, 117, 129},
                                                                  {146, 218, 221}}};
  return kColours[static_cast<std::size_t>(group) % kColours.size()];
}

}  // namespace svnet
