#pragma once
#include <Eigen/Geometry>
#include <array>
#include <string>
#include <utility>

#include "base/enum_names.h"
#include "base/index.h"
#include "view/camera_pose.h"

// Cameras on the half-sphere around an object (docs/camera-convention.md). Lengths are in metres; the world's z axis is
// vertical.
namespace svnet::view {

/// A pinhole camera without distortion: pixel (x, y), with (0, 0) in the centre of the upper left pixel, sees the
/// direction ((x - cx) / fx, (y - cy) / fy, 1) of the optical frame.
struct Intrinsics {
  Index width = 0, height = 0;  // pixels
  double fx = 0, fy = 0;        // focal lengths in pixels
  double cx = 0, cy = 0;        // the principal point in pixels
};

/// What is wrong with intrinsics, such as "fx is 0, expected a positive number of pixels"; empty if they are valid.
std::string intrinsics_problem(const Intrinsics&);

/// The axes of a camera:
///   paper    z forward, x left, y up; x is horizontal
///   optical  z forward, x right, y down, as pixels are counted (ROS REP-103)
enum class CameraFrame { paper, optical };
constexpr auto enum_table(CameraFrame) {
  return std::to_array<EnumName<CameraFrame>>({{CameraFrame::paper, "paper"}, {CameraFrame::optical, "optical"}});
}
/// Throws Error for an unknown name.
CameraFrame camera_frame_named(const std::string& name);

/// The share of the smaller side of the image that the object's diagonal spans.
constexpr double kViewShare = 0.7;

/// The distance at which a segment of length `diagonal_m` parallel to the image plane spans kViewShare of the image
/// along the side with the smaller angle of view: R = d / kViewShare · max(fx / width, fy / height).
double viewing_radius_m(const Intrinsics&, double diagonal_m);

/// The unit vector from the object to the camera, (cos φ cos θ, cos φ sin θ, sin φ).
Eigen::Vector3d outwards(const CameraPose&);

/// Camera to world, of a camera at centre + radius · outwards(pose) that looks at the centre with a horizontal x axis.
/// At φ = 90° the x axis is the limit of those below for the same θ. Throws Error unless the pose is in range, the
/// radius positive and everything finite.
Eigen::Isometry3d look_at(const CameraPose&, double radius_m, const Eigen::Vector3d& centre_m, CameraFrame);

/// The camera's orientation as files store it: the one with w >= 0 of the two quaternions.
Eigen::Quaterniond orientation(const Eigen::Isometry3d& camera_to_world);

/// A camera's position (m) and orientation() as files and answers store them: x_m, y_m, z_m, qx, qy, qz, qw.
std::array<std::pair<const char*, double>, 7> position_and_orientation(const Eigen::Isometry3d& camera_to_world);

/// The pixel at which a point of the optical frame (z > 0) appears.
Eigen::Vector2d projected_px(const Intrinsics&, const Eigen::Vector3d& point_optical_m);

/// The point of the optical frame with depth z = `depth_m` that appears at the pixel (x, y).
Eigen::Vector3d deprojected_m(const Intrinsics&, double x_px, double y_px, double depth_m);

}  // namespace svnet::view
