#pragma once
#include <Eigen/Geometry>

#include "demo_dataset/solid.h"
#include "models/image/image.h"

namespace svnet::demo {

/// A solid put down on the table z = 0: a point of the solid is rotation · p + shift in the world.
struct Placed {
  const Solid& solid;
  Eigen::Matrix3f rotation;
  Vec3 shift;
  Vec3 centre;     ///< of the bounding box, in the world
  float diagonal;  ///< √(length² + width² + height²)
};

/// Rests the rotated solid on the table.
Placed put_down(const Solid& solid, const Eigen::Matrix3f& rotation);

/// What a camera sees from (θ, φ) on the half-sphere around the object's centre, from where the diagonal spans 70 % of
/// the picture: (size, size), one directional light with shadows, four rays for each pixel.
Image picture(const Placed& object, int theta_deg, int phi_deg, Index size);

}  // namespace svnet::demo
