#pragma once
#include <Eigen/Geometry>
#include <memory>

#include "image/depth_image.h"
#include "image/image.h"
#include "simulation/mesh.h"
#include "simulation/render/caster.h"
#include "simulation/setting.h"
#include "view/camera.h"

namespace svnet::simulation {

/// The key of an image's random numbers: pixel p uses the index `number` << 32 | p of the seed, on any thread.
struct ImageKey {
  std::uint64_t seed = 0;
  std::uint32_t number = 0;
};

/// What an ideal camera sees, without the noise of a sensor.
struct Shot {
  Index height = 0, width = 0;
  std::vector<Vec3> radiance;  // linear RGB, 1 is white
  DepthImage depth;
  std::vector<std::uint8_t> mask;  // 255 if the pixel's centre sees the object, else 0
};

/// An object on a table, ray-traced with Embree. Without a mesh the table is empty; a mesh must outlive the scene.
/// Thread-safe, and the number of threads does not change a bit of the result.
class Scene {
 public:
  Scene(const Mesh* mesh, const Eigen::Isometry3d& object_to_world, const Setting&);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// `camera_to_world` is the pose of the optical frame. Requires a camera above the table. Traces `samples` rays per
  /// pixel (1, 2 or 4), the first one through its centre. Throws Error for another number.
  Shot shoot(const view::Intrinsics&, const Eigen::Isometry3d& camera_to_world, const ImageKey&, int samples) const;

  /// For benchmarks, on one thread: the caster of the object, null if the table is empty.
  Caster* caster();

 private:
  struct Tracer;
  std::unique_ptr<Tracer> tracer_;
};

}  // namespace svnet::simulation
