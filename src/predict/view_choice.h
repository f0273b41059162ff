#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "frame/next_inputs.h"
#include "view/camera_pose.h"

// Choices among camera poses by their scores.
namespace svnet::predict {

/// The index of the highest score, the first of equal ones. Throws Error if there are no scores.
std::size_t best_view(std::span<const float> scores);

/// The indices of all scores, highest score first; equal scores keep their order.
std::vector<std::size_t> best_first(std::span<const float> scores);

/// Chooses up to chosen.size() poses to take together, each judged by its score and by how far it is from those already
/// chosen, at least `min_angle_deg` (view/view_set.h). Writes their indices, and returns how many there are: fewer if
/// no other pose is far enough away. Requires one score per pose. Throws Error unless there are poses, room for one
/// choice, and an angle in [0, 180]. `nearest` is scratch memory, which gets the size of poses; nothing else is
/// allocated.
std::size_t best_views(std::span<const float> scores, std::span<const view::CameraPose> poses, double min_angle_deg,
                       std::span<std::size_t> chosen, std::vector<double>& nearest);
/// The same with memory of its own.
std::size_t best_views(std::span<const float> scores, std::span<const view::CameraPose> poses, double min_angle_deg,
                       std::span<std::size_t> chosen);

/// Whether the pose is another one than those taken, and at least min_angle_deg from each of them, less 1e-4 degrees for
/// rounding.
bool is_apart(const view::CameraPose& pose, std::span<const frame::TakenView> taken, double min_angle_deg);

/// The index of the highest score among the poses that are apart from the taken ones; none if no pose is. Requires one
/// score per pose. Throws Error unless the angle is in [0, 180].
std::optional<std::size_t> next_view(std::span<const float> scores, std::span<const view::CameraPose> poses,
                                     std::span<const frame::TakenView> taken, double min_angle_deg);

}  // namespace svnet::predict
