#pragma once
#include <vector>

#include "base/random.h"
#include "simulation/mesh.h"

namespace svnet {

/// A round lamp.
struct Lamp {
  Vec3 place_m;
  float radius_m;
  Vec3 irradiance;  // on a surface at the origin that faces it
};

/// Table and light. Everything stands on the table z = 0.
struct Setting {
  Material table;
  std::vector<Lamp> lamps;
  Vec3 sky{0.4f, 0.4f, 0.4f};      // radiance from above
  Vec3 wall{0.25f, 0.25f, 0.25f};  // radiance from the horizon
};

/// One of the tables and light conditions of the collection.
Setting random_setting(RandomStream&);

}  // namespace svnet
