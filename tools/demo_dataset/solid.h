#pragma once
#include <Eigen/Core>
#include <array>

#include "base/random.h"

namespace svnet::demo {

using Vec3 = Eigen::Vector3f;

/// From above, bottle, bowl, can, cone and plate are discs; box, hammer and mug give themselves away.
enum class Category { bottle, bowl, box, can, cone, hammer, mug, plate };
inline constexpr std::array<const char*, 8> kCategoryNames{"bottle", "bowl",   "box", "can",
                                                           "cone",   "hammer", "mug", "plate"};

/// One object: a category's shape with proportions and colours of its own. Metres, upright around the z axis.
class Solid {
 public:
  Solid(Category category, RandomStream& random);

  /// A lower bound of the distance to the surface, negative inside, exact near it (Hart, "Sphere tracing", 1996).
  float distance(const Vec3& p) const;
  /// The colour of the part that is nearest to p, RGB in [0, 1].
  const Vec3& colour(const Vec3& p) const;
  /// Whether it can also be put down on its side.
  bool can_lie() const;

 private:
  /// Distances to the body, in the first colour, and to the second part.
  Eigen::Vector2f parts(const Vec3& p) const;

  Category category_;
  float a_, b_, c_;  // the proportions, in [0, 1)
  Vec3 colours_[2];
};

}  // namespace svnet::demo
