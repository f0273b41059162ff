#pragma once
#include "simulation/render/caster.h"
#include "simulation/render/light_kernels.h"

namespace svnet::simulation {

/// Where an object is.
struct ObjectPlace {
  Eigen::Matrix3f to_world_rotation;
  Eigen::Matrix4f to_local;
};

/// The rays of a batch that hit the object, and what only they need.
struct ObjectSurfaces {
  Picked picked;
  const Material* material[kRays];  // of picked ray k
  Row<std::uint8_t> metal;          // of picked ray k: 1 or 0

  // Room for add_object_surfaces.
  Corners corners;
  Rows3 origin, direction, local;
  Row<float> distance;
  Surfaces surfaces;
};

/// Fills the surfaces of the rays object.picked, by their hits.
void add_object_surfaces(const Mesh&, const ObjectPlace&, const Rows3& origin, const Rows3& direction,
                         const Caster::Hits&, ObjectSurfaces& object, Surfaces&);

}  // namespace svnet::simulation
