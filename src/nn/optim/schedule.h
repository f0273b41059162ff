#pragma once
#include <cstdint>

#include "base/enum_names.h"

namespace svnet {

/// The learning rate of each training step.
///   constant  base
///   step      base · factor^⌊step / period⌋
///   cosine    base · (1 + cos(π · step / total)) / 2, and 0 after `total` steps
/// During the first `warm_up` steps the rate rises linearly to base. The formulas count steps from the end of these.
struct Schedule {
  enum class Kind { constant, step, cosine };
  Kind kind = Kind::constant;
  double base = 1e-3;
  std::int64_t period = 1;  // step: steps between two changes, positive
  double factor = 0.1;
  std::int64_t total = 1;    // cosine: steps in all, positive
  std::int64_t warm_up = 0;  // steps

  double at(std::int64_t step) const;
};

constexpr auto enum_table(Schedule::Kind) {
  return std::to_array<EnumName<Schedule::Kind>>(
      {{Schedule::Kind::constant, "constant"}, {Schedule::Kind::step, "step"}, {Schedule::Kind::cosine, "cosine"}});
}

}  // namespace svnet
