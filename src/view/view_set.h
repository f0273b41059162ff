#pragma once
#include <cstddef>
#include <span>
#include <vector>
#include <vector>

#include "base/function_ref.h"
#include "view/camera_pose.h"

namespace svnet::view {

/// How poses that are taken together are chosen: one after the other, each time the one with the highest
///   score + spread · deviation of the scores · min(angle, 90°) / 90°
/// where the angle is that to the nearest pose chosen before. So the second view of an object is not almost the first
/// one again, unless all others are much worse.
struct ViewSetOptions {
  double min_angle_deg = 0;  ///< between any two chosen poses (angle_between_deg, less 1e-4 degrees for rounding)
  double spread = 1;         ///< 0: by the scores alone. 1 was the best for two and three views (docs/selection.md).
};

/// Writes the indices of up to chosen.size() poses, and returns how many there are: fewer if no other pose is far enough
/// away. In a tie the first pose is taken; a score that is NaN is never. `nearest` is scratch memory: it gets the size of
/// poses, and nothing else is allocated. Throws Error unless there is room for one choice, and an angle in [0, 180].
std::size_t choose_view_set(std::span<const CameraPose> poses, FunctionRef<double(std::size_t)> score,
                            const ViewSetOptions& options, std::span<std::size_t> chosen,
                            std::vector<double>& nearest);

}  // namespace svnet::view
