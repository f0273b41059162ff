#include "predict/view_choice.h"

#include <algorithm>
#include <numeric>

#include "base/error.h"

namespace svnet::predict {

std::size_t best_view(std::span<const float> scores) {
  check(!scores.empty(), "[predict] there is no pose to choose from");
  return static_cast<std::size_t>(std::max_element(scores.begin(), scores.end()) - scores.begin());
}

std::vector<std::size_t> best_first(std::span<const float> scores) {
  std::vector<std::size_t> order(scores.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return scores[a] > scores[b]; });
  return order;
}

std::size_t best_views(std::span<const float> scores, std::span<const view::CameraPose> poses, double min_angle_deg,
                       std::span<std::size_t> chosen) {
  check(!chosen.empty(), "[predict] 0 views are to be chosen, expected at least one");
  check(min_angle_deg >= 0 && min_angle_deg <= 180, "[predict] the views are to differ by ", min_angle_deg,
        " degrees, expected 0 to 180");
  chosen[0] = best_view(scores);
  std::size_t count = 1;
  const auto is_before = [&](std::size_t a, std::size_t b) {
    return scores[a] > scores[b] || (scores[a] == scores[b] && a < b);
  };
  const auto differs = [&](std::size_t i) {
    return std::ranges::all_of(chosen.first(count), [&](std::size_t other) {
      return min_angle_deg == 0 ||
             angle_between_deg(poses[i], poses[other]) >= min_angle_deg - view::kAngleTolerance_deg;
    });
  };
  for (; count < chosen.size(); ++count) {
    // What comes before the last choice was chosen, or is too near to one of the choices.
    const std::size_t none = scores.size();
    std::size_t next = none;
    for (std::size_t i = 0; i < scores.size(); ++i)
      if (is_before(chosen[count - 1], i) && (next == none || is_before(i, next)) && differs(i)) next = i;
    if (next == none) break;
    chosen[count] = next;
  }
  return count;
}

}  // namespace svnet::predict
