#pragma once
#include <Eigen/Geometry>
#include <array>
#include <span>
#include <vector>

#include "simulation/mesh.h"

namespace svnet::simulation {

/// The triangles of the convex hull as indices of points, counter-clockwise from outside (incremental algorithm).
/// Points are moved by up to 10⁻⁵ of the extent, so a point may lie outside the hull by that much. Throws Error if all
/// points are in one plane.
std::vector<std::array<std::uint32_t, 3>> convex_hull(std::span<const Eigen::Vector3d> points);

/// A stable way in which a solid rests on a table.
struct RestingPose {
  Eigen::Quaterniond rotation;  // object to world, up to a rotation about the vertical
  double centre_height_m;       // of the centre of mass above the table
  double share;                 // solid angle of the face as seen from the centre of mass, of 4π
};

/// The faces of the convex hull on which the solid stays when tilted by 2.5°; if there are none, the most stable face.
///
/// Faces on which the centre of mass is equally high form a kind (a can on either end; the sides of a bottle). The
/// result lists the best face of each kind, kinds by falling share, then the second best of each, and so on. Kinds with
/// a share below 8 % are left out, except for the first.
///
/// Of a mesh of more than `exact_points` points only those count that are outermost in one of 4096 directions: within
/// 0.05 % of the extent.
std::vector<RestingPose> resting_poses(const Mesh&, std::size_t exact_points = 32768);

}  // namespace svnet::simulation
