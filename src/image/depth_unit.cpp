#include "image/depth_unit.h"

#include <cmath>

#include "base/error.h"
#include "base/text.h"

namespace svnet {

double depth_unit_m(std::string_view text) {
  static constexpr std::array<DepthUnit, 4> kSuffixes{{{"cm", 0.01}, {"mm", 0.001}, {"um", 1e-6}, {"m", 1}}};
  std::string_view factor = text;
  double metres = 1;
  for (const DepthUnit& suffix : kSuffixes)
    if (text.ends_with(suffix.name)) {
      factor.remove_suffix(suffix.name.size());
      while (factor.ends_with(' ')) factor.remove_suffix(1);
      metres = suffix.metres;
      break;
    }
  double number = 1;
  const bool is_number = (factor.empty() && !text.empty()) || parse_number(factor, number);
  check(is_number, "the unit of depth '", printable(text),
        "' is not known; expected m, cm, mm, 0.25mm, 0.2mm or the like, or metres per unit (0.001)");
  metres *= number;
  check(metres >= 1e-6 && metres <= 1, "the unit of depth '", printable(text), "' is ", metres,
        " m, expected 0.000001 to 1 m");
  return metres;
}

std::string depth_unit_name(double metres) {
  for (const DepthUnit& unit : kDepthUnits)
    if (std::abs(unit.metres - metres) < 1e-6 * metres) return std::string(unit.name);
  return joined(metres, " m");
}

}  // namespace svnet
