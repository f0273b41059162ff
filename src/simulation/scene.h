#pragma once
#include <Eigen/Geometry>
#include <memory>

#include "image/depth_image.h"
#include "image/image.h"
#include "simulation/mesh.h"
#include "simulation/setting.h"
#include "view/camera.h"

namespace svnet {

/// The random numbers of one picture: every pixel draws from stream `number` << 32 | pixel of `seed`, whatever the
/// thread.
struct PictureKey {
  std::uint64_t seed = 0;
  std::uint32_t number = 0;
};

/// What a perfect camera sees, before its sensor's noise.
struct Shot {
  Index height = 0, width = 0;
  std::vector<Vec3> radiance;  // linear RGB, 1 is white
  DepthImage depth;
  std::vector<std::uint8_t> mask;  // 255 where the pixel's centre sees the object, else 0
};

/// An object on a table, traced with Embree. The same bits on one machine for any number of threads; a scene may be
/// looked at from several threads at once. `mesh` must live as long; without one the table is empty.
class Scene {
 public:
  Scene(const Mesh* mesh, const Eigen::Isometry3d& object_to_world, const Setting&);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// `camera_to_world` in the optical frame; the camera must be above the table. `samples` rays per pixel, the first
  /// one through its centre.
  Shot shoot(const Intrinsics&, const Eigen::Isometry3d& camera_to_world, const PictureKey&, int samples) const;

 private:
  struct Tracer;
  std::unique_ptr<Tracer> tracer_;
};

}  // namespace svnet
