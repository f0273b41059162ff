#pragma once
#include <cstdint>

namespace svnet {

/// The learning rate of each training step.
/// constant: base. step: base · factor^⌊step / period⌋. cosine: base · (1 + cos(π · step / total)) / 2, 0 from total
/// on.
struct Schedule {
  enum class Kind { constant, step, cosine };
  Kind kind = Kind::constant;
  double base = 1e-3;
  std::int64_t period = 1;  // step: steps between two changes, positive
  double factor = 0.1;
  std::int64_t total = 1;  // cosine: steps in all, positive

  double at(std::int64_t step) const;
};

}  // namespace svnet
