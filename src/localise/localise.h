#pragma once
#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

#include "image/depth_image.h"
#include "image/image.h"
#include "view/camera.h"

// Measures where an object is and how large (section 3 of the paper), from one RGB-D image of the empty table and one
// with the object, both from the same camera pose.
namespace svnet::localise {

struct RgbdView {
  const Image& rgb;
  const DepthImage& depth;
};

struct LocaliseOptions {
  bool take_largest = false;  // of several objects, measure the largest; otherwise they are an Error
  bool keep_steps = false;    // make LocalisedObject::steps
  /// Whether somebody has said in which unit depth is stored. Otherwise the table's height may make it doubtful.
  bool unit_is_certain = false;
};

/// The names of the images of the steps: the difference of the colours, the object's pixels, their contour with the
/// rectangle and the centre, the rise in depth.
constexpr std::array<const char*, 4> kLocaliseSteps{"difference", "foreground", "contour", "height"};

struct LocalisedObject {
  /// The geometric centre GC in the world: the centre of the circle around the contour (enclosing_circle.h), at half
  /// the height.
  Eigen::Vector3d centre_m;
  /// The longer and the shorter side of the smallest rectangle around the contour in the world's xy plane.
  double length_m, width_m;
  double height_m;           // above the table
  double yaw_rad;            // angle from the world's x axis to the longer side, in [0, π)
  double diagonal_m;         // d = √(length² + width² + height²)
  std::vector<Image> steps;  // the images of kLocaliseSteps; empty without keep_steps
};

/// Finds the object. Its pixels are those that changed their colour, except for shadows, which only got darker and did
/// not rise, and those that rose by more than 4 mm. Pixels next to these belong to it if they changed half as much.
/// A changed brightness of the light, sensor noise and pixels without depth are tolerated. `camera_to_world` is the
/// pose of the optical frame in a world whose z axis is vertical.
///
/// Throws Error if the images do not have the camera's size, nothing is found, the object touches the border, there
/// are several objects, less than a quarter of the object's pixels have depth, the object lies below the table (the
/// images are exchanged), the camera looks less than 6 degrees downwards, the table is tilted by 20 degrees or more,
/// the object is larger than 1.5 m, or the unit of depth is doubtful: the table is far from z = 0, and with another
/// unit it is not.
LocalisedObject locate(const view::Intrinsics&, const Eigen::Isometry3d& camera_to_world, const RgbdView& background,
                       const RgbdView& current, const LocaliseOptions& = {});

}  // namespace svnet::localise
