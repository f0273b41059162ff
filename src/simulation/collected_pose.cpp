#include "simulation/collected_pose.h"

#include "base/error.h"

namespace svnet::simulation {
namespace {

/// Whether the object reaches the border of the image.
bool is_cut_off(const Shot& shot) {
  const auto object_at = [&](Index y, Index x) { return shot.mask[static_cast<std::size_t>(y * shot.width + x)] != 0; };
  for (Index x = 0; x < shot.width; ++x)
    if (object_at(0, x) || object_at(shot.height - 1, x)) return true;
  for (Index y = 0; y < shot.height; ++y)
    if (object_at(y, 0) || object_at(y, shot.width - 1)) return true;
  return false;
}

/// Places the object, localises it and captures its views. Throws Error if it is not found or cut off.
CollectedPose attempt(const RestingMesh& object, Index pose, Index size, std::uint64_t seed, std::uint32_t number) {
  const PosedObject posed = pose_object(object.mesh, object.resting, pose, seed, number);
  const Scene scene(&object.mesh, posed.object_to_world, posed.setting);
  const Overview overview = capture_overview(posed, scene, seed, number);
  CollectedPose result{posed,
                       overview,
                       localise::locate(overview_camera(), overview_camera_to_world(),
                                        {overview.background.rgb, overview.background.depth},
                                        {overview.current.rgb, overview.current.depth}),
                       {}};
  for (std::size_t view = 0; view < posed.views.size(); ++view) {
    result.views.push_back(capture_view(posed, scene, result.object, size, seed, number, view));
    check(!is_cut_off(result.views.back().shot), "the object is cut off in a view");
    result.views.back().shot.radiance = {};  // only the image needed it
  }
  return result;
}

}  // namespace

PoseCollection collect_pose(const RestingMesh& object, Index pose, Index size, std::uint64_t seed,
                            std::uint32_t number) {
  constexpr std::uint32_t kMostAttempts = 16;
  PoseCollection result;
  while (!result.pose && result.attempts < kMostAttempts) {
    try {
      result.pose = attempt(object, pose, size, seed * 1009 + result.attempts++, number);
    } catch (const Error& error) {
      result.problem = joined("not collected in ", kMostAttempts, " tries: ", error.what());
    }
  }
  if (result.pose) result.problem.clear();
  return result;
}

}  // namespace svnet::simulation
