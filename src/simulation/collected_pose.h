#pragma once
#include <optional>
#include <string>
#include <vector>

#include "simulation/collection.h"
#include "simulation/object_in_work.h"

namespace svnet::simulation {

/// A pose that a robot collected: the object was found in the overview and is seen as a whole in every view.
struct CollectedPose {
  PosedObject posed;
  Overview overview;
  localise::LocalisedObject object;
  std::vector<CapturedView> views;  // one for each of posed.views; shot.radiance is empty
};

/// The outcome of collect_pose.
struct PoseCollection {
  std::optional<CollectedPose> pose;  // empty if every attempt failed
  std::uint32_t attempts = 0;
  std::string problem;  // why there is no pose
};

/// Collects pose `pose` of an object with views of size x size pixels. An attempt fails if the object is not found in
/// the overview or is cut off in a view; the next one has another light and another place on the table. After 16 failed
/// attempts the pose is given up. `number` as for pose_object.
PoseCollection collect_pose(const RestingMesh&, Index pose, Index size, std::uint64_t seed, std::uint32_t number);

}  // namespace svnet::simulation
