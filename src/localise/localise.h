#pragma once
#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

#include "image/depth_image.h"
#include "image/image.h"
#include "view/camera.h"

// Where an object is, and how large: section 3 of the paper, on a picture of the empty table and one with the object,
// taken from the same place.
namespace svnet {

struct RgbdView {
  const Image& rgb;
  const DepthImage& depth;
};

struct LocaliseOptions {
  bool take_largest = false;  // of several objects, rather than to refuse them
  bool keep_steps = false;    // the pictures for the eye
};

/// The steps of the work that there are pictures of: what differs, what belongs to the object, its contour with the
/// rectangle and GC, how high it rises.
constexpr std::array<const char*, 4> kLocaliseSteps{"difference", "foreground", "contour", "height"};

struct LocalisedObject {
  Eigen::Vector3d centre_m;  // GC: the middle of the smallest circle around the contour (enclosing_circle.h), half way
                             // up; world
  double length_m,
      width_m;        // the longer and the shorter side of the smallest rectangle around the contour in the xy plane
  double height_m;    // above the table
  double yaw_rad;     // of the longer side from the world's x axis, in [0, π)
  double diagonal_m;  // d = √(length² + width² + height²)
  std::vector<Image> steps;  // of kLocaliseSteps, where they were to be kept
};

/// Finds the object. What changed in colour belongs to it, unless it only got darker and lies no higher than before (a
/// shadow), and so does what rose by more than 4 mm; beside that, what changed half as much. Slow changes of the light
/// and sensor noise do not matter, nor do holes in depth. `camera_to_world` is the optical frame's pose in a world
/// whose z axis is vertical.
///
/// Throws Error where pictures do not fit the camera, nothing is found, the object is cut off by the border, there are
/// several objects, what is new lies below the table, or the camera does not look down at it.
LocalisedObject localise(const Intrinsics&, const Eigen::Isometry3d& camera_to_world, const RgbdView& background,
                         const RgbdView& current, const LocaliseOptions& = {});

}  // namespace svnet
