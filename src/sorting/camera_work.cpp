#include "sorting/camera_work.h"

namespace svnet::sorting {

CameraWork camera_work(std::span<const view::CameraPose> poses, const MoveTime& time) {
  constexpr double kStays_deg = 1e-4;  // angles are rounded
  CameraWork work;
  view::CameraPose from = view::kTopView;
  for (const view::CameraPose& to : poses) {
    const double angle_deg = view::angle_between_deg(from, to);
    from = to;
    if (angle_deg > kStays_deg) work += {1, time.start_s + angle_deg / time.speed_deg_per_s};
  }
  return work;
}

}  // namespace svnet::sorting
