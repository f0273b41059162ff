#include "predict/view_choice.h"

#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "view/view_set.h"

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
                       std::span<std::size_t> chosen, std::vector<double>& nearest) {
  check(!scores.empty(), "[predict] there is no pose to choose from");
  return choose_view_set(
      poses, [&](std::size_t i) { return static_cast<double>(scores[i]); }, {.min_angle_deg = min_angle_deg}, chosen,
      nearest);
}

std::size_t best_views(std::span<const float> scores, std::span<const view::CameraPose> poses, double min_angle_deg,
                       std::span<std::size_t> chosen) {
  std::vector<double> nearest;
  return best_views(scores, poses, min_angle_deg, chosen, nearest);
}

bool is_apart(const view::CameraPose& pose, std::span<const frame::TakenView> taken, double min_angle_deg) {
  const double least = std::max(min_angle_deg - view::kAngleTolerance_deg, view::kAngleTolerance_deg);
  return std::ranges::all_of(
      taken, [&](const frame::TakenView& view) { return view::angle_between_deg(pose, view.pose) >= least; });
}

std::optional<std::size_t> next_view(std::span<const float> scores, std::span<const view::CameraPose> poses,
                                     std::span<const frame::TakenView> taken, double min_angle_deg) {
  check(min_angle_deg >= 0 && min_angle_deg <= 180, "[predict] the least angle is ", min_angle_deg,
        " degrees, expected 0 to 180");
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (is_apart(poses[i], taken, min_angle_deg) && (!best || scores[i] > scores[*best])) best = i;
  return best;
}

}  // namespace svnet::predict
