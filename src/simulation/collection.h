#pragma once
#include <functional>
#include <span>
#include <string>

#include "localise/localise.h"
#include "simulation/mesh.h"
#include "simulation/resting.h"
#include "simulation/scene.h"
#include "simulation/sensor.h"

// One pose of one object, as a robot would collect it: an overview from above, localisation, the views of the paper.
namespace svnet {

/// Where the object lies, what it lies on and under which light, which views are missing.
struct PosedObject {
  const Mesh* mesh;
  Eigen::Isometry3d object_to_world;
  Setting setting;
  std::vector<Pose> views;
};

/// Pose number `pose` of an object: each of its resting poses in turn, turned and moved at random. `number` < 2^16
/// tells the object and pose apart from all others of a collection.
PosedObject pose_object(const Mesh&, Index pose, std::uint64_t seed, std::uint32_t number);
/// With its resting poses, which cost seconds where a mesh is large.
PosedObject pose_object(const Mesh&, std::span<const RestingPose>, Index pose, std::uint64_t seed,
                        std::uint32_t number);

/// The camera of the overview: 640x480, 1 m above the table, looking down.
Intrinsics overview_camera();
Eigen::Isometry3d overview_camera_to_world();
/// What it may find at all: it sees about 1 m of the table, and less than a pixel of what is smaller.
constexpr double kSmallestObject_m = 0.001, kLargestObject_m = 1;
/// The camera of the views: size x size with the same angle of view as the paper's.
Intrinsics view_camera(Index size);

/// The empty table and the object from the overview camera, with sensor noise and a small change of light in between.
struct Overview {
  RgbdPicture background, current;
};
Overview take_overview(const PosedObject&, std::uint64_t seed, std::uint32_t number);
/// With the scene of the posed object.
Overview take_overview(const PosedObject&, const Scene&, std::uint64_t seed, std::uint32_t number);

/// Number `view` of object.views, from where the localised object asks for.
struct TakenView {
  Shot shot;
  RgbdPicture picture;
};
TakenView take_view(const PosedObject&, const Scene&, const LocalisedObject&, Index size, std::uint64_t seed,
                    std::uint32_t number, std::size_t view);

}  // namespace svnet
