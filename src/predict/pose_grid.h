#pragma once
#include <vector>

#include "models/pose.h"

namespace svnet {

/// The candidates of the paper: azimuth every 45° but for 270°, where the camera would see the robot's base, at
/// elevations 45°, 60° and 75°, by rising elevation, then azimuth; and at last the top view, (90°, 90°).
std::vector<Pose> paper_grid();

}  // namespace svnet
