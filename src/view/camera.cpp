#include "view/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace svnet::view {

std::string intrinsics_problem(const Intrinsics& camera) {
  if (camera.width <= 0 || camera.height <= 0)
    return joined("the image has ", camera.width, "x", camera.height, " pixels, expected a positive width and height");
  for (const auto& [name, value, size] :
       {std::tuple("fx", camera.fx, camera.width), std::tuple("fy", camera.fy, camera.height)}) {
    if (!(std::isfinite(value) && value > 0))
      return joined(name, " is ", value, ", expected a positive number of pixels");
    if (value < 0.01 * static_cast<double>(size))
      return joined(name, " is ", value, " for ", size, " pixels: no camera sees so much; is it in pixels?");
  }
  for (const auto& [name, value, size] :
       {std::tuple("cx", camera.cx, camera.width), std::tuple("cy", camera.cy, camera.height)})
    if (!(value >= -0.5 && value <= static_cast<double>(size) - 0.5))
      return joined(name, " is ", value, ", which is outside the image of ", size, " pixels");
  return "";
}

CameraFrame camera_frame_named(const std::string& name) {
  const auto found = find_enum<CameraFrame>(name);
  check(found.has_value(), "the camera frame '", name, "' is not known", suggestion(name, names_of<CameraFrame>()));
  return *found;
}

double viewing_radius_m(const Intrinsics& camera, double diagonal_m) {
  const std::string problem = intrinsics_problem(camera);
  check(problem.empty(), "[view] ", problem);
  check(std::isfinite(diagonal_m) && diagonal_m > 0, "[view] the object's diagonal is ", diagonal_m,
        " m, expected a positive length");
  return diagonal_m / kViewShare *
         std::max(camera.fx / static_cast<double>(camera.width), camera.fy / static_cast<double>(camera.height));
}

Eigen::Vector3d outwards(const CameraPose& pose) {
  const double theta = pose.theta_deg * std::numbers::pi / 180, phi = pose.phi_deg * std::numbers::pi / 180;
  return {std::cos(phi) * std::cos(theta), std::cos(phi) * std::sin(theta), std::sin(phi)};
}

Eigen::Isometry3d look_at(const CameraPose& given, double radius_m, const Eigen::Vector3d& centre_m,
                          CameraFrame frame) {
  const std::string problem = pose_problem(given);
  check(problem.empty(), "[view] ", problem);
  const CameraPose pose = clamped_pose(given);
  check(std::isfinite(radius_m) && radius_m > 0, "[view] the radius is ", radius_m, " m, expected a positive length");
  check(centre_m.allFinite(), "[view] the centre (", centre_m.transpose(), ") is not finite");
  const double theta = pose.theta_deg * std::numbers::pi / 180;
  const Eigen::Vector3d away = outwards(pose);
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translation() = centre_m + radius_m * away;
  const Eigen::Vector3d z = -away, x(std::sin(theta), -std::cos(theta), 0), y = z.cross(x);
  if (frame == CameraFrame::paper)
    result.linear() << x, y, z;
  else
    result.linear() << -x, -y, z;
  check(result.translation().allFinite(), "[view] the camera's place is not finite: the centre is (",
        centre_m.transpose(), "), the radius ", radius_m, " m");
  return result;
}

Eigen::Quaterniond orientation(const Eigen::Isometry3d& camera_to_world) {
  Eigen::Quaterniond q(camera_to_world.linear());
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  return q;
}

std::array<std::pair<const char*, double>, 7> position_and_orientation(const Eigen::Isometry3d& camera_to_world) {
  const Eigen::Vector3d t = camera_to_world.translation();
  const Eigen::Quaterniond q = orientation(camera_to_world);
  return {{{"x_m", t.x()}, {"y_m", t.y()}, {"z_m", t.z()}, {"qx", q.x()}, {"qy", q.y()}, {"qz", q.z()}, {"qw", q.w()}}};
}

Eigen::Vector2d projected_px(const Intrinsics& camera, const Eigen::Vector3d& point) {
  return {camera.cx + camera.fx * point.x() / point.z(), camera.cy + camera.fy * point.y() / point.z()};
}

Eigen::Vector3d deprojected_m(const Intrinsics& camera, double x_px, double y_px, double depth_m) {
  return {(x_px - camera.cx) / camera.fx * depth_m, (y_px - camera.cy) / camera.fy * depth_m, depth_m};
}

}  // namespace svnet::view
