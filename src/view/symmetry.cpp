#include "view/symmetry.h"

#include <algorithm>
#include <cmath>

namespace svnet::view {

void apply_symmetry(int symmetry, Index side, const float* from, float* to) {
  const Index end = side - 1;
  for (Index i = 0; i < side; ++i)
    for (Index j = 0; j < side; ++j) {
      Index row = i, column = j;
      for (int turn = 0; turn < symmetry % 4; ++turn) {
        const Index above = row;
        row = column;
        column = end - above;
      }
      if (symmetry >= 4) column = end - column;
      std::copy_n(from + (row * side + column) * 3, 3, to + (i * side + j) * 3);
    }
}

double symmetric_theta_deg(int symmetry, double theta_deg) {
  const double theta = std::fmod((symmetry >= 4 ? 180 - theta_deg : theta_deg) + 90 * (symmetry % 4), 360.0);
  const double turned = theta < 0 ? theta + 360 : theta;
  return turned < 360 ? turned : 0;  // a tiny negative angle is rounded to 360
}

}  // namespace svnet::view
