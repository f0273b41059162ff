#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "view/camera_pose.h"

// Choices among camera poses by their scores.
namespace svnet::predict {

/// The index of the highest score, the first of equal ones. Throws Error if there are no scores.
std::size_t best_view(std::span<const float> scores);

/// The indices of all scores, highest score first; equal scores keep their order.
std::vector<std::size_t> best_first(std::span<const float> scores);

/// Chooses up to chosen.size() poses that differ: the best first, then each time the best of those that are at least
/// `min_angle_deg` away from every chosen one (view::angle_between_deg, less 1e-4 degrees for rounding); in a tie the
/// first. Writes their indices, and returns how many there are: fewer if no other pose is far enough away.
/// Requires one score per pose. Throws Error unless there are poses, room for one choice, and an angle in [0, 180].
/// Allocates nothing.
std::size_t best_views(std::span<const float> scores, std::span<const view::CameraPose> poses, double min_angle_deg,
                       std::span<std::size_t> chosen);

}  // namespace svnet::predict
