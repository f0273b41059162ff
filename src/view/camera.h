#pragma once
#include <Eigen/Geometry>
#include <string>
#include <string_view>

#include "base/index.h"
#include "view/pose.h"

// Camera poses on the half-sphere around an object (docs/camera-convention.md). Lengths are in metres; the world's z
// axis is vertical.
namespace svnet {

/// A pinhole camera without distortion: pixel (x, y), with (0, 0) in the centre of the upper left pixel, sees the
/// direction ((x - cx) / fx, (y - cy) / fy, 1) of the optical frame.
struct Intrinsics {
  Index width = 0, height = 0;  // pixels
  double fx = 0, fy = 0;        // focal lengths in pixels
  double cx = 0, cy = 0;        // the principal point in pixels
};

/// What is wrong with intrinsics, such as "fx is 0, expected a positive number of pixels"; empty where nothing is.
std::string intrinsics_problem(const Intrinsics&);

/// The axes that a camera's orientation is given by:
///   paper    z towards what it looks at, x level, y upwards (x to the left of the picture)
///   optical  z forward, x right, y down, as pixels are numbered (ROS REP-103)
enum class CameraFrame { paper, optical };

/// As commands name them. camera_frame_named throws Error for an unknown name.
std::string name_of(CameraFrame);
CameraFrame camera_frame_named(std::string_view name);

/// The share of the smaller side of the picture that the object's diagonal spans.
constexpr double kViewShare = 0.7;

/// The distance at which a segment of length `diagonal_m` parallel to the image plane spans kViewShare of the picture
/// along the side with the smaller angle of view: R = d / kViewShare · max(fx / width, fy / height).
double viewing_radius_m(const Intrinsics&, double diagonal_m);

/// The unit vector from the object to the camera, (cos φ cos θ, cos φ sin θ, sin φ).
Eigen::Vector3d outwards(const Pose&);

/// Camera to world: the camera at centre + R outwards(pose), looking at the centre, x level. At
/// φ = 90° x has the direction of the limit for the given θ. Throws Error unless the pose is in range and R is
/// positive.
Eigen::Isometry3d camera_pose(const Pose&, double radius_m, const Eigen::Vector3d& centre_m, CameraFrame);

/// The rotation of a pose as files have it: of the two quaternions the one with w >= 0.
Eigen::Quaterniond orientation(const Eigen::Isometry3d& camera_to_world);

/// The pixel that a point of the optical frame (z > 0) is seen at.
Eigen::Vector2d projected_px(const Intrinsics&, const Eigen::Vector3d& point_optical_m);

/// The point of the optical frame that pixel (x, y) sees at the depth z = `depth_m`.
Eigen::Vector3d deprojected_m(const Intrinsics&, double x_px, double y_px, double depth_m);

}  // namespace svnet
