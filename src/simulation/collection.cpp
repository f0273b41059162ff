#include "simulation/collection.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "simulation/resting.h"
#include "view/pose_grid.h"

namespace svnet::simulation {
using view::CameraFrame;
using view::Intrinsics;

namespace {

// Indices of the images of one pose, 0 … 2^16 - 1; views have their own index. kPlan keys the numbers of pose_object.
constexpr std::uint32_t kOverview = 0xfffd, kBackground = 0xfffe, kPlan = 0xffff;

ImageKey key_of(std::uint64_t seed, std::uint32_t number, std::uint32_t image) { return {seed, number << 16 | image}; }

}  // namespace

PosedObject pose_object(const Mesh& mesh, Index pose, std::uint64_t seed, std::uint32_t number) {
  return pose_object(mesh, resting_poses(mesh), pose, seed, number);
}

PosedObject pose_object(const Mesh& mesh, std::span<const RestingPose> resting, Index pose, std::uint64_t seed,
                        std::uint32_t number) {
  check(number < 0x10000, "[collect] there are more than 65536 objects and poses");
  RandomStream random(seed, Stream::collection, std::uint64_t{key_of(seed, number, kPlan).number} << 32);
  const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  PosedObject posed{&mesh, Eigen::Isometry3d::Identity(), random_setting(random), {}};
  posed.object_to_world.linear() = (Eigen::AngleAxisd(between(0, 2 * std::numbers::pi), Eigen::Vector3d::UnitZ()) *
                                    resting[static_cast<std::size_t>(pose) % resting.size()].rotation)
                                       .toRotationMatrix();
  Eigen::AlignedBox3d box;
  for (const Vec3& point : mesh.points) box.extend(posed.object_to_world * point.cast<double>());
  const double y = between(-0.04, 0.04), x = between(-0.04, 0.04);
  posed.object_to_world.translation() =
      Eigen::Vector3d(x, y, 0) - Eigen::Vector3d(box.center().x(), box.center().y(), box.min().z());

  // A robot cannot reach some views: mostly 0 to 2, rarely up to 5; the top view is never missing.
  posed.views = view::paper_grid();
  const double u = random.uniform();
  for (auto missing = static_cast<int>(6 * u * u * u); missing > 0; --missing)
    posed.views.erase(posed.views.begin() + random.below(static_cast<std::uint32_t>(posed.views.size()) - 1));
  return posed;
}

Intrinsics overview_camera() { return {640, 480, 600, 600, 319.5, 239.5}; }

Eigen::Isometry3d overview_camera_to_world() {
  return look_at({90, 90}, 1, Eigen::Vector3d::Zero(), CameraFrame::optical);
}

Intrinsics view_camera(Index size) {
  const auto side = static_cast<double>(size);
  return {size, size, 1.25 * side, 1.25 * side, (side - 1) / 2, (side - 1) / 2};
}

Overview capture_overview(const PosedObject& posed, std::uint64_t seed, std::uint32_t number) {
  return capture_overview(posed, Scene(posed.mesh, posed.object_to_world, posed.setting), seed, number);
}

Overview capture_overview(const PosedObject& posed, const Scene& scene, std::uint64_t seed, std::uint32_t number) {
  constexpr int kSamples = 2;
  RandomStream random(seed, Stream::collection,
                      std::uint64_t{key_of(seed, number, kOverview).number} << 32 | 0xffffffff);
  const auto brighter = static_cast<float>(0.97 + 0.06 * random.uniform());
  const auto image = [&](const Scene& seen, std::uint32_t index, float exposure) {
    const ImageKey key = key_of(seed, number, index);
    return sensor_image(seen.shoot(overview_camera(), overview_camera_to_world(), key, kSamples), key, exposure);
  };
  const Scene empty(nullptr, posed.object_to_world, posed.setting);
  return {image(empty, kBackground, 1), image(scene, kOverview, brighter)};
}

CapturedView capture_view(const PosedObject& posed, const Scene& scene, const localise::LocalisedObject& object,
                          Index size, std::uint64_t seed, std::uint32_t number, std::size_t view) {
  constexpr int kSamples = 4;
  const Intrinsics camera = view_camera(size);
  const Eigen::Isometry3d from =
      look_at(posed.views[view], viewing_radius_m(camera, object.diagonal_m), object.centre_m, CameraFrame::optical);
  const ImageKey key = key_of(seed, number, static_cast<std::uint32_t>(view));
  CapturedView captured{scene.shoot(camera, from, key, kSamples), {}};
  captured.image = sensor_image(captured.shot, key);
  return captured;
}

}  // namespace svnet::simulation
