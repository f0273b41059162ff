#pragma once
#include <Eigen/Geometry>
#include <array>
#include <span>
#include <vector>

#include "simulation/mesh.h"

namespace svnet {

/// Triangles of the convex hull, counter-clockwise from outside, as numbers of points (incremental, with the horizon of
/// what each point sees). Points that are coplanar to about 10⁻⁵ of the extent may lie a trifle outside. Throws Error
/// where all points are in one plane.
std::vector<std::array<std::uint32_t, 3>> convex_hull(std::span<const Eigen::Vector3d> points);

/// A way in which a solid lies still on a table.
struct RestingPose {
  Eigen::Quaterniond rotation;  // object to world, up to a turn about the vertical
  double centre_height_m;       // of the centre of mass above the table
  double share;                 // of all directions in which gravity pulls it onto this face, from the centre of mass
};

/// The faces of the convex hull that carry the centre of mass by at least 2.5° of tilt. Faces on which the centre of
/// mass is equally high are the same kind of pose (an upright can, head or foot; the sides of a bottle): first comes
/// the best face of each kind, kinds with the largest share first, then the second best, and so on. Kinds with less
/// than 8 % of all directions are left out, unless nothing else is there. At least one. Of a mesh of more than 32768
/// points only those count that lie outermost in one of 4096 directions, which are within 0.05 % of its extent.
std::vector<RestingPose> resting_poses(const Mesh&);

}  // namespace svnet
