#pragma once
#include <string>

namespace svnet {

/// The direction from the object to the camera: azimuth θ, and elevation φ above the table, in degrees.
struct CameraPose {
  double theta_deg = 0;  // in [-360, 720]: one turn more or less is the same pose
  double phi_deg = 0;    // in [0, 90]; 90 is the top view

  bool operator==(const CameraPose&) const = default;
};

/// How far an angle may be out of its range and still mean the bound: rounding of 32-bit floats and of radians in text.
constexpr double kAngleRounding_deg = 1e-4;

/// The pose with angles that are out of range by rounding alone moved to the bound.
CameraPose without_rounding(const CameraPose& pose);

/// What is wrong with the angles, such as "phi 95 is outside [0, 90] degrees"; empty if they are valid, up to
/// rounding.
std::string pose_problem(const CameraPose& pose);

}  // namespace svnet
