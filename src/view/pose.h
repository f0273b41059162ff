#pragma once
#include <string>

namespace svnet {

/// Where a camera looks at the object from: the azimuth θ and the elevation φ above the table, in degrees.
struct Pose {
  double theta_deg = 0;  // in [-360, 720]: one turn more or less is the same pose
  double phi_deg = 0;    // in [0, 90]; 90 is the top view

  bool operator==(const Pose&) const = default;
};

/// What is wrong with a pose's angles, such as "phi 95 is outside [0, 90] degrees"; empty where nothing is.
std::string pose_problem(const Pose& pose);

}  // namespace svnet
