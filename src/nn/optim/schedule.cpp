#include "nn/optim/schedule.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace svnet {

double Schedule::at(std::int64_t step) const {
  if (step < warm_up) return base * static_cast<double>(step + 1) / static_cast<double>(warm_up + 1);
  step -= warm_up;
  switch (kind) {
    case Kind::constant:
      return base;
    case Kind::step:
      return base * std::pow(factor, static_cast<double>(step / period));
    case Kind::cosine: {
      const double done = std::min(1.0, static_cast<double>(step) / static_cast<double>(total));
      return base * 0.5 * (1 + std::cos(std::numbers::pi * done));
    }
  }
  return base;
}

}  // namespace svnet
