#pragma once
#include <string>

namespace svnet {

/// The direction from the object to the camera: azimuth θ, and elevation φ above the table, in degrees.
struct CameraPose {
  double theta_deg = 0;  // in [-360, 720]: one turn more or less is the same pose
  double phi_deg = 0;    // in [0, 90]; 90 is the top view

  bool operator==(const CameraPose&) const = default;
};

/// What is wrong with the angles, such as "phi 95 is outside [0, 90] degrees"; empty if they are valid.
std::string pose_problem(const CameraPose& pose);

}  // namespace svnet
