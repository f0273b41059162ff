#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "base/parallel.h"
#include "simulation/catalogue.h"
#include "simulation/collection.h"
#include "simulation/resting.h"
#include "simulation/sculptor.h"
#include "simulation/texture.h"

using namespace svnet;
using namespace svnet::localise;
using namespace svnet::simulation;
using namespace svnet::view;

namespace {

Mesh box_mesh(float x, float y, float z) {
  Sculptor sculptor;
  sculptor.use({});
  sculptor.box(x, y, z, 0.1f);
  return sculptor.take();
}

double area(const Outline& points, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    const Vec2 u = points[b] - points[a], v = points[c] - points[a];
    sum += (u.x() * v.y() - u.y() * v.x()) / 2;
  }
  return sum;
}

/// The volume by the divergence theorem; positive if the triangles face outwards.
double volume(const Mesh& mesh) {
  double sum = 0;
  for (const Mesh::Triangle& triangle : mesh.triangles)
    sum += mesh.points[triangle.corner[0]].cast<double>().dot(
               mesh.points[triangle.corner[1]].cast<double>().cross(mesh.points[triangle.corner[2]].cast<double>())) /
           6;
  return sum;
}

}  // namespace

TEST_CASE("outlines with holes are triangulated without gaps or overlaps") {
  const Outline outline = rounded_rectangle(100, 60, 8);
  const std::vector<Outline> holes{moved(circle(10, 24), -25, 0), moved(circle(10, 12), 25, 5),
                                   moved(circle(4, 9), 0, -15)};
  Outline points = outline;
  double expected = area(outline, triangulated(outline, {}));
  CHECK(expected == Approx(6000 - (4 - 3.14159) * 64).epsilon(0.005));
  for (const Outline& hole : holes) {
    points.insert(points.end(), hole.begin(), hole.end());
    expected -= area(hole, triangulated(hole, {}));
  }
  const auto triangles = triangulated(outline, holes);
  CHECK(area(points, triangles) == Approx(expected).epsilon(1e-5));
  CHECK(triangles.size() == points.size() + 2 * holes.size() - 2);
}

TEST_CASE("shapes enclose their volume, facing outwards") {
  const auto volume_of = [](const auto& shape) {
    Sculptor sculptor;
    sculptor.use({});
    shape(sculptor);
    return 1e9 * volume(sculptor.take());  // mm³
  };
  CHECK(volume_of([](Sculptor& s) { s.box(10, 20, 30, 0.01f); }) == Approx(6000).epsilon(0.002));
  CHECK(volume_of([](Sculptor& s) { s.cylinder(10, 20, 0.01f); }) == Approx(6283).epsilon(0.01));
  CHECK(volume_of([](Sculptor& s) { s.ball(10, 20, 5); }) == Approx(4189).epsilon(0.02));
  CHECK(volume_of([](Sculptor& s) { s.torus(30, 5); }) == Approx(14804).epsilon(0.06));
  CHECK(volume_of([](Sculptor& s) { s.tube({{0, 0, 0}, {0, 0, 10}, {0, 0, 20}}, {5}); }) == Approx(1571).epsilon(0.05));
  CHECK(volume_of([](Sculptor& s) { s.hoop({{10, 0}, {12, 0}, {12, 5}, {10, 5}}); }) == Approx(691).epsilon(0.01));
  CHECK(volume_of([](Sculptor& s) { s.plate(circle(20), 3, 0, {circle(10)}); }) == Approx(2827).epsilon(0.02));
  CHECK(volume_of([](Sculptor& s) {
          s.strip({{0, 10, 6}, {30, 10, 6}});
        }) == Approx(30 * 3.1416 * 10 * 3).epsilon(0.03));
  CHECK(volume_of([](Sculptor& s) { s.box(10, 20, 30, 0.01f).scale(1, -1, 1).turn_x(40).move(5, 5, 5); }) ==
        Approx(6000).epsilon(0.002));
}

TEST_CASE("the centre of mass and the hull are those of the solid") {
  Sculptor sculptor;
  sculptor.use({});
  sculptor.box(10, 20, 30).move(100, 0, -50);
  const Mesh mesh = sculptor.take();
  CHECK((centre_of_mass(mesh) - Eigen::Vector3d(0.1, 0, -0.05)).norm() < 1e-5);

  // For any orientation of the faces. A fin next to a cube has a large area and a small volume.
  sculptor.use({});
  sculptor.box(50, 50, 50);
  sculptor.box(200, 2, 50).move(100, 0, 0);
  Mesh fin = sculptor.take();
  const Eigen::Vector3d centre = centre_of_mass(fin);
  for (Mesh::Triangle& triangle : fin.triangles) std::swap(triangle.corner[1], triangle.corner[2]);
  CHECK((centre_of_mass(fin) - centre).norm() < 1e-5);

  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 27; ++i) points.emplace_back(i % 3, i / 3 % 3, i / 9);  // corners, edges, faces and the middle
  double hull_volume = 0;
  for (const auto& [a, b, c] : convex_hull(points)) hull_volume += points[a].dot(points[b].cross(points[c])) / 6;
  CHECK(hull_volume == Approx(8).epsilon(1e-3));
  CHECK_THROWS_WITH(convex_hull(std::span(points).first(9)),
                    "[resting] all points are in one plane, which is no solid");
  CHECK_THROWS_WITH(convex_hull(std::span(points).first(3)), "[resting] 3 points without extent have no convex hull");
}

TEST_CASE("a block rests on its faces, the largest first, and stands on none of its edges") {
  const auto poses = resting_poses(box_mesh(40, 60, 100));
  REQUIRE(poses.size() == 6);
  const double heights_mm[] = {20, 30, 50};
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(1000 * poses[i].centre_height_m == Approx(heights_mm[i % 3]).margin(0.2));
    const Eigen::Matrix3d rotation = poses[i].rotation.toRotationMatrix();
    CHECK(rotation.cwiseAbs().rowwise().maxCoeff().minCoeff() > 0.999);  // axes to axes
  }
  // A tall, thin stick does not stand on its end.
  for (const RestingPose& pose : resting_poses(box_mesh(4, 4, 200))) CHECK(1000 * pose.centre_height_m < 3);
}

TEST_CASE("every object of the catalogue is a solid of reasonable size that rests on the table", "[slow]") {
  REQUIRE(catalogue_names().size() == 29);
  for (const char* held_out : {"comb", "hammer", "knife", "toothbrush", "wrench"})
    CHECK(std::count(catalogue_names().begin(), catalogue_names().end(), held_out) == 1);
  for (const std::string& category : catalogue_names())
    for (Index object = 0; object < 7; ++object) {
      INFO(category << " " << object);
      const Mesh mesh = catalogue_object(category, object, 1);
      REQUIRE(mesh.normals.size() == mesh.triangles.size());
      CHECK(mesh.triangles.size() < 30000);
      Eigen::AlignedBox3f box;
      bool finite = true;
      for (const Vec3& point : mesh.points) finite &= point.allFinite(), box.extend(point);
      CHECK(finite);
      CHECK(box.diagonal().norm() > 0.04f);
      CHECK(box.diagonal().norm() < 0.55f);
      CHECK(volume(mesh) > 1e-7);
      const auto poses = resting_poses(mesh);
      for (const RestingPose& pose : poses) CHECK(pose.rotation.norm() == Approx(1));
    }
  CHECK_THROWS_WITH(catalogue_object("hamer", 0, 1), "there is no category 'hamer', did you mean 'hammer'?");
}

TEST_CASE("a scene sees a block where the camera's equations put it") {
  const Mesh mesh = box_mesh(100, 60, 40);
  RandomStream random(1, Stream::collection);
  const Scene scene(&mesh, Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.02)), random_setting(random));
  const Intrinsics camera{101, 81, 100, 100, 50, 40};
  const auto from = look_at({90, 90}, 1, {0, 0, 0}, CameraFrame::optical);
  const Shot shot = scene.shoot(camera, from, {}, 1);
  // The top face is 0.96 m away: 100 mm are 10.4 pixels, 60 mm are 6.25.
  for (Index y = 0; y < 81; ++y)
    for (Index x = 0; x < 101; ++x) {
      const double u = std::abs(static_cast<double>(x) - 50), v = std::abs(static_cast<double>(y) - 40);
      const bool inside = u < 5.2 && v<3.1, outside = u> 5.3 || v > 3.2;
      const auto pixel = static_cast<std::size_t>(y * 101 + x);
      if (inside) CHECK(shot.mask[pixel] == 255);
      if (outside) CHECK(shot.mask[pixel] == 0);
      if (inside) CHECK(shot.depth.metres[pixel] == Approx(0.96).epsilon(1e-4));
      if (outside) CHECK(shot.depth.metres[pixel] == Approx(1).epsilon(1e-4));
    }
}

TEST_CASE("the sensor's noise is that of the paper's camera") {
  Shot shot;
  shot.height = shot.width = shot.depth.height = shot.depth.width = 200;
  shot.radiance.assign(40000, Vec3(0.2f, 0.2f, 0.2f));
  shot.depth.metres.assign(40000, 0.8f);
  shot.mask.assign(40000, 0);
  shot.depth.metres[100 * 200 + 100] = 0.5f;  // a spike, whose neighbours are on a silhouette
  const RgbdImage image = sensor_image(shot, {3, 7});
  double sum = 0, squares = 0;
  Index holes = 0, count = 0;
  for (const float z : image.depth.metres) {
    if (z == 0) ++holes;
    if (z < 0.6f) continue;
    CHECK(std::abs(1000 * z - std::round(1000 * z)) < 1e-3f);
    sum += static_cast<double>(z) - 0.8, squares += (static_cast<double>(z) - 0.8) * (static_cast<double>(z) - 0.8),
        ++count;
  }
  CHECK(holes > 0);
  CHECK(holes <= 5);
  CHECK(sum / static_cast<double>(count) == Approx(0).margin(2e-5));
  // σ = 1.4 mm · 0.8², and the rounding's 1 mm / √12.
  CHECK(1000 * std::sqrt(squares / static_cast<double>(count)) == Approx(std::hypot(1.4 * 0.64, 0.2887)).epsilon(0.03));
  double level = 0;
  for (const std::uint8_t value : image.rgb.rgb) level += value;
  CHECK(level / 120000 == Approx(static_cast<double>(srgb_from_linear(0.2f))).margin(0.5));
  CHECK(sensor_image(shot, {3, 8}).rgb.rgb != image.rgb.rgb);
  CHECK(sensor_image(shot, {3, 7}).rgb.rgb == image.rgb.rgb);
}

TEST_CASE("conversion to sRGB and back is the identity") {
  for (int level = 0; level < 256; ++level)
    CHECK(srgb_from_linear(linear_from_srgb(static_cast<std::uint8_t>(level))) == Approx(level).margin(0.3));
}

TEST_CASE("views show a localised object completely, and about one of 22 views is missing") {
  Index views = 0, poses = 0;
  for (const char* category : {"hammer", "mug", "plate", "key"}) {
    const Mesh mesh = catalogue_object(category, 1, 1);
    const PosedObject posed = pose_object(mesh, 0, 11, 5);
    const Overview overview = capture_overview(posed, 11, 5);
    const LocalisedObject object = localise::locate(overview_camera(), overview_camera_to_world(),
                                                    {overview.background.rgb, overview.background.depth},
                                                    {overview.current.rgb, overview.current.depth});
    const Scene scene(&mesh, posed.object_to_world, posed.setting);
    for (std::size_t view = 0; view < posed.views.size(); view += 4) {
      const Shot shot = capture_view(posed, scene, object, 64, 11, 5, view).shot;
      bool cut_off = false;
      Index seen = 0;
      for (Index i = 0; i < 64; ++i)
        for (Index k : {i, 64 * 63 + i, 64 * i, 64 * i + 63}) cut_off |= shot.mask[static_cast<std::size_t>(k)] != 0;
      for (const std::uint8_t value : shot.mask) seen += value != 0;
      INFO(category << ", view " << view);
      CHECK_FALSE(cut_off);
      CHECK(seen > 40);
    }
  }
  const Mesh mesh = box_mesh(40, 60, 100);
  for (std::uint32_t number = 0; number < 300; ++number) {
    const auto posed = pose_object(mesh, 0, 1, number);
    CHECK(posed.views.size() >= 17);
    CHECK(posed.views.back() == CameraPose{90, 90});
    views += static_cast<Index>(posed.views.size()), ++poses;
  }
  const double mean = static_cast<double>(views) / static_cast<double>(poses);
  CHECK(mean > 20.3);  // the paper's mean is 21.1
  CHECK(mean < 21.7);
}
