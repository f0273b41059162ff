#include "view/view_set.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace svnet::view {
namespace {

/// The standard deviation of the scores that are not NaN; 0 if there are none.
double deviation_of(std::size_t count, FunctionRef<double(std::size_t)> score) {
  double n = 0, mean = 0, squares = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double value = score(i);
    if (std::isnan(value)) continue;
    const double before = value - mean;
    mean += before / ++n;
    squares += before * (value - mean);
  }
  return n > 0 ? std::sqrt(squares / n) : 0;
}

}  // namespace

std::size_t choose_view_set(std::span<const CameraPose> poses, FunctionRef<double(std::size_t)> score,
                            const ViewSetOptions& options, std::span<std::size_t> chosen,
                            std::vector<double>& nearest) {
  check(!chosen.empty(), "[views] 0 views are to be chosen, expected at least one");
  check(options.min_angle_deg >= 0 && options.min_angle_deg <= 180, "[views] the views are to differ by ",
        options.min_angle_deg, " degrees, expected 0 to 180");
  const double weight = options.spread * deviation_of(poses.size(), score) / 90;
  constexpr double kTaken = -1;
  nearest.assign(poses.size(), 180.0);
  std::size_t count = 0;
  for (; count < chosen.size(); ++count) {
    double best = -std::numeric_limits<double>::infinity();
    const std::size_t none = poses.size();
    std::size_t next = none;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (nearest[i] == kTaken || nearest[i] < options.min_angle_deg - kAngleTolerance_deg) continue;
      const double value = score(i) + weight * std::min(nearest[i], 90.0);
      if (value > best) {  // false for NaN
        best = value;
        next = i;
      }
    }
    if (next == none) break;
    chosen[count] = next;
    for (std::size_t i = 0; i < poses.size(); ++i)
      if (nearest[i] != kTaken) nearest[i] = std::min(nearest[i], angle_between_deg(poses[i], poses[next]));
    nearest[next] = kTaken;
  }
  return count;
}

}  // namespace svnet::view
