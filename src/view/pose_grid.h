#pragma once
#include <vector>

#include "base/index.h"
#include "view/camera_pose.h"

namespace svnet::view {

/// The paper's 22 camera poses: elevations 45°, 60° and 75°, at each the azimuths 0°, 45°, … 315° without 270°, from
/// where the camera would see the robot's base; then the top view (90°, 90°). Sorted by elevation, then azimuth.
std::vector<CameraPose> paper_grid();

/// `count` poses spread evenly over the half-sphere above the elevation `lowest_phi_deg`, on a Fibonacci lattice: pose
/// i has sin φ = s + (1 - s)(i + ½) / count with s = sin(lowest φ), and θ is i golden angles. Throws Error unless count
/// is positive and lowest_phi_deg is in [0, 90).
std::vector<CameraPose> fibonacci_half_sphere(Index count, double lowest_phi_deg);

}  // namespace svnet::view
