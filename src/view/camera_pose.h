#pragma once
#include <string>

namespace svnet::view {

/// The direction from the object to the camera: azimuth θ, and elevation φ above the table, in degrees.
struct CameraPose {
  double theta_deg = 0;  // in [-360, 720]: one turn more or less is the same pose
  double phi_deg = 0;    // in [0, 90]; 90 is the top view

  bool operator==(const CameraPose&) const = default;
};

/// The pose straight above the object.
inline constexpr CameraPose kTopView{90, 90};

/// How far an angle may be out of range, in degrees: conversions to float32 and to radians and back round that much.
constexpr double kAngleTolerance_deg = 1e-4;

/// What is wrong with the angles, such as "phi 95 is outside [0, 90] degrees"; empty if they are valid, or out of range
/// by no more than the tolerance.
std::string pose_problem(const CameraPose& pose);

/// The pose with angles that are out of range by no more than the tolerance taken for the bound. For poses without a
/// problem.
CameraPose clamped_pose(const CameraPose& pose);

/// The angle between the directions of two poses along the great circle, in [0, 180] degrees.
double angle_between_deg(const CameraPose& a, const CameraPose& b);

}  // namespace svnet::view
