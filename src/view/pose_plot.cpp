#include "view/pose_plot.h"

#include "view/half_sphere_canvas.h"

namespace svnet::view {

Image pose_plot(std::span<const CameraPose> poses, const std::vector<bool>& reachable) {
  constexpr Colour kDot{33, 145, 140}, kOutline{40, 40, 40}, kEmpty{255, 255, 255};
  constexpr double kRadius_px = 8;
  HalfSphereCanvas canvas;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    canvas.disc(kOutline, poses[i], kRadius_px + 1);
    canvas.disc(reachable[i] ? kDot : kEmpty, poses[i], kRadius_px);
  }
  return canvas.take();
}

}  // namespace svnet::view
