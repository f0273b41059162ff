#pragma once
#include <vector>

#include "base/function_ref.h"
#include "base/index.h"
#include "view/camera_pose.h"

namespace svnet::view {

/// The paper's 22 camera poses: elevations 45°, 60° and 75°, at each the azimuths 0°, 45°, … 315° without 270°, from
/// where the camera would see the robot's base; then the top view (90°, 90°). Sorted by elevation, then azimuth.
std::vector<CameraPose> paper_grid();

/// A grid of azimuths and elevations. Azimuths are evenly spread over the whole turn, from 0; elevations from the
/// lowest to the highest, both included.
struct GridSpec {
  Index theta_steps = 36;  ///< in [1, 3600]
  Index phi_steps = 10;    ///< in [1, 1000]; 1: the lowest elevation alone
  double lowest_phi_deg = 0, highest_phi_deg = 90;
};

/// The number of poses of a grid. Throws Error unless the numbers of steps are in range and 0 <= lowest <= highest <=
/// 90 degrees.
Index grid_size(const GridSpec& spec);

/// Calls add(pose) for each pose of a grid, sorted by elevation, then azimuth. An elevation of 90 degrees has no
/// azimuth: it is one pose, kTopView. Throws Error as grid_size.
void for_each_pose(const GridSpec& spec, FunctionRef<void(const CameraPose&)> add);

/// The poses of a grid, in that order.
std::vector<CameraPose> pose_grid(const GridSpec& spec);

/// `count` poses spread evenly over the half-sphere above the elevation `lowest_phi_deg`, on a Fibonacci lattice: pose
/// i has sin φ = s + (1 - s)(i + ½) / count with s = sin(lowest φ), and θ is i golden angles. Throws Error unless count
/// is positive and lowest_phi_deg is in [0, 90).
std::vector<CameraPose> fibonacci_half_sphere(Index count, double lowest_phi_deg);

}  // namespace svnet::view
