#include "report/axis.h"

#include <algorithm>
#include <cmath>

#include "report/markup.h"

namespace svnet::report {

std::vector<double> Axis::ticks() const {
  std::vector<double> ticks;
  const auto count = static_cast<int>(std::lround((high - low) / step));
  for (int i = 0; i <= count; ++i) ticks.push_back(low + i * step);
  return ticks;
}

std::string Axis::tick_text(double tick) const {
  const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
  return number(tick, digits);
}

Axis round_axis(double low, double high, int intervals, double from_px, double to_px) {
  if (!std::isfinite(low) || !std::isfinite(high)) low = 0, high = 1;
  if (high - low < 1e-9) low -= 0.05, high += 0.05;
  const double rough = (high - low) / intervals, power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * power >= rough * 0.999) step = factor * power;
  return {.low = std::floor(low / step + 1e-9) * step,
          .high = std::ceil(high / step - 1e-9) * step,
          .step = step,
          .from_px = from_px,
          .to_px = to_px};
}

}  // namespace svnet::report
