#pragma once
#include <vector>

#include "base/index.h"
#include "view/pose.h"

namespace svnet {

/// The candidates of the paper: azimuth every 45° but for 270°, where the camera would see the robot's base, at
/// elevations 45°, 60° and 75°, by rising elevation, then azimuth; and at last the top view, (90°, 90°).
std::vector<Pose> paper_grid();

/// `count` poses spread evenly over the half-sphere from the elevation `lowest_phi_deg` upwards: a Fibonacci lattice,
/// pose i at sin φ = s + (1 - s)(i + ½) / count with s = sin(lowest φ), and at i golden angles. Throws Error unless
/// count is positive and lowest_phi_deg in [0, 90).
std::vector<Pose> fibonacci_half_sphere(Index count, double lowest_phi_deg);

}  // namespace svnet
