#pragma once
#include <functional>
#include <span>
#include <string>

#include "localise/localise.h"
#include "simulation/mesh.h"
#include "simulation/resting.h"
#include "simulation/scene.h"
#include "simulation/sensor.h"

// The steps of collecting one pose of one object as a robot does: place it, take an overview, take the paper's views.
// `number` < 2^16 identifies the object and pose in a dataset; with the seed it determines all random numbers.
namespace svnet::simulation {

/// An object on a table under some light, and the camera poses that the robot reaches.
struct PosedObject {
  const Mesh* mesh;
  Eigen::Isometry3d object_to_world;
  Setting setting;
  std::vector<view::CameraPose> views;
};

/// Pose `pose` of an object. Successive poses use its resting poses in turn; the object is rotated about the vertical
/// and moved at random. The mesh must outlive the result. Throws Error if number >= 2^16.
PosedObject pose_object(const Mesh&, Index pose, std::uint64_t seed, std::uint32_t number);
/// With the mesh's resting poses, which take a second for a large mesh.
PosedObject pose_object(const Mesh&, std::span<const RestingPose>, Index pose, std::uint64_t seed,
                        std::uint32_t number);

/// The camera of the overview: 640x480, 1 m above the table, looking down.
view::Intrinsics overview_camera();
Eigen::Isometry3d overview_camera_to_world();
/// The sizes of objects that it can find: it sees about 1 m of the table, and 1 mm is less than a pixel.
constexpr double kSmallestObject_m = 0.001, kLargestObject_m = 1;
/// The camera of the views: size x size pixels, the angle of view of the paper's camera.
view::Intrinsics view_camera(Index size);

/// Images of the empty table and of the object from the overview camera. The light changes a little between them.
struct Overview {
  RgbdImage background, current;
};
Overview capture_overview(const PosedObject&, std::uint64_t seed, std::uint32_t number);
/// With the scene of the posed object.
Overview capture_overview(const PosedObject&, const Scene&, std::uint64_t seed, std::uint32_t number);

/// View `view` of posed.views: the camera looks at the localised object's centre from its viewing radius.
struct CapturedView {
  Shot shot;
  RgbdImage image;
};
CapturedView capture_view(const PosedObject&, const Scene&, const localise::LocalisedObject&, Index size,
                          std::uint64_t seed, std::uint32_t number, std::size_t view);

}  // namespace svnet::simulation
