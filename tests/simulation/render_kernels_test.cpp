// Rays in vectors: the same bits on every instruction set, and as the same formulas for one ray.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "base/instruction_sets.h"
#include "simulation/catalogue.h"
#include "simulation/collection.h"
#include "simulation/render/light_kernels.h"
#include "simulation/render/texture_kernels.h"
#include "simulation/resting.h"
#include "simulation/texture.h"

using namespace svnet;
using namespace svnet::simulation;
using namespace svnet::test;

TEST_CASE("textures of many points are those of each point") {
  Material material;
  material.colour = Vec3(0.7f, 0.5f, 0.31f);
  material.second = Vec3(0.2f, 0.55f, 0.3f);
  material.scale_m = 0.0071f;
  RandomStream random(3, Stream::collection);
  Rows3 points, colours;
  for (std::size_t i = 0; i < kRays; ++i) {
    const auto coordinate = [&] { return static_cast<float>(0.3 * random.uniform() - 0.15); };
    const float z = coordinate(), y = coordinate();
    points.set(i, Vec3(coordinate(), y, z));
  }
  for_instruction_sets([&](const std::string& isa) {
    for (const Texture texture :
         {Texture::plain, Texture::wood, Texture::brushed, Texture::speckled, Texture::stripes, Texture::checks}) {
      material.texture = texture;
      for (const std::size_t count : {std::size_t{1}, std::size_t{17}, kRays}) {
        paint(material, count, points, colours);
        for (std::size_t i = 0; i < count; ++i) {
          INFO(isa << ", texture " << static_cast<int>(texture) << ", point " << i);
          CHECK(colours.get(i) == surface_colour(material, points.get(i), Vec2::Zero(), {}));
        }
      }
    }
  });
}

TEST_CASE("rays of a camera, to the table and into a box") {
  const view::Intrinsics camera{640, 480, 600, 580, 310.5, 239.5};
  const Eigen::Matrix3f rotation =
      view::look_at({40, 75}, 0.7, {0, 0, 0}, view::CameraFrame::optical).linear().cast<float>();
  const Eigen::AlignedBox3f box(Vec3(-0.05f, -0.02f, 0), Vec3(0.04f, 0.03f, 0.1f));
  Row<std::uint32_t> x, y, word;
  Rows3 origin;
  Row<float> near, far, meets, distance;
  for (std::size_t i = 0; i < kRays; ++i) {
    x[i] = static_cast<std::uint32_t>(i * 37 % 640), y[i] = static_cast<std::uint32_t>(i * 61 % 480);
    word[i] = random_words(1, Stream::collection, i, 0)[0];
    origin.set(i, Vec3(0.1f, 0.2f, 0.66f));
    far[i] = 2;
  }
  for_instruction_sets([&](const std::string& isa) {
    for (std::uint32_t sample = 0; sample < 4; ++sample) {
      CameraRays rays;
      make_camera_rays(camera, rotation, kRays, x, y, sample, word, rays);
      find_table(kRays, origin, rays.direction, near, distance);
      test_box(kRays, box, origin, rays.direction, far, meets);
      for (std::size_t i = 0; i < kRays; ++i) {
        INFO(isa << ", sample " << sample << ", ray " << i);
        const auto part = [](std::uint32_t bits) { return static_cast<float>(bits & 0xffffu) * 0x1p-17f; };
        const float dx = sample == 0 ? 0 : ((sample & 1) != 0 ? 0.0f : -0.5f) + part(word[i]);
        const float dy = sample == 0 ? 0 : ((sample & 2) != 0 ? 0.0f : -0.5f) + part(word[i] >> 16);
        const Vec3 seen(static_cast<float>((x[i] + static_cast<double>(dx) - camera.cx) / camera.fx),
                        static_cast<float>((y[i] + static_cast<double>(dy) - camera.cy) / camera.fy), 1);
        const Vec3 direction = rotation * (seen / seen.norm());
        CHECK(rays.length[i] == seen.norm());
        CHECK(rays.direction.get(i) == direction);
        CHECK(distance[i] == (direction.z() < 0 ? -origin.z[i] / direction.z() : HUGE_VALF));
        const Vec3 inverse = direction.cwiseInverse();
        const Vec3 a = (box.min() - origin.get(i)).cwiseProduct(inverse),
                   b = (box.max() - origin.get(i)).cwiseProduct(inverse);
        const float enter = a.cwiseMin(b).maxCoeff(), leave = a.cwiseMax(b).minCoeff();
        CHECK(meets[i] == (leave >= std::max(enter, 0.0f) && enter <= far[i] ? 1.0f : 0.0f));
      }
    }
  });
}

TEST_CASE("pictures have the same bits on every instruction set") {
  for (const char* category : {"glass", "hammer", "watch"}) {
    const Mesh mesh = catalogue_object(category, 1, 1);
    const PosedObject posed = pose_object(mesh, 0, 11, 5);
    const Scene scene(&mesh, posed.object_to_world, posed.setting);
    const auto from = view::look_at({30, 60}, 0.5, {0, 0, 0.03}, view::CameraFrame::optical);
    Shot first;
    RgbdImage first_image;
    for_instruction_sets([&](const std::string& isa) {
      INFO(category << ", " << isa);
      const Shot shot = scene.shoot(view_camera(75), from, {3, 4}, 4);
      const RgbdImage image = sensor_image(shot, {3, 4});
      if (first.radiance.empty()) first = shot, first_image = image;
      CHECK(shot.radiance == first.radiance);
      CHECK(shot.depth.metres == first.depth.metres);
      CHECK(shot.mask == first.mask);
      CHECK(image.rgb.rgb == first_image.rgb.rgb);
      CHECK(image.depth.metres == first_image.depth.metres);
    });
  }
}

TEST_CASE("samples per pixel are 1, 2 or 4") {
  RandomStream random(1, Stream::collection);
  const Scene scene(nullptr, Eigen::Isometry3d::Identity(), random_setting(random));
  CHECK_THROWS_WITH(
      scene.shoot(view_camera(32), view::look_at({90, 90}, 1, {0, 0, 0}, view::CameraFrame::optical), {}, 3),
      "[render] 3 samples per pixel; expected 1, 2 or 4");
}
