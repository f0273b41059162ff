#pragma once
#include <vector>

#include "base/random.h"
#include "simulation/mesh.h"

namespace svnet::simulation {

/// A round lamp.
struct Lamp {
  Vec3 place_m;
  float radius_m;
  Vec3 irradiance;  // on a surface at the origin that faces the lamp
};

/// The table, which is the plane z = 0, and the light.
struct Setting {
  Material table;
  std::vector<Lamp> lamps;
  Vec3 sky{0.4f, 0.4f, 0.4f};      // radiance from above
  Vec3 wall{0.25f, 0.25f, 0.25f};  // radiance from the horizon
};

/// A table and light drawn at random.
Setting random_setting(RandomStream&);

}  // namespace svnet::simulation
