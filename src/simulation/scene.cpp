// Direct light of round lamps with soft shadows, one bounce of the room's light (sky, walls, table), highlights and
// mirrored surroundings. Shadows of lamps and room are sampled with one ray each per sample.
//
// Rays of up to 256 pixels go through each step together: light_kernels.h has the arithmetic, caster.h the triangles.
// A sample of all pixels of such a batch is a pass; rays through clear surfaces go on in smaller batches.
#include "simulation/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "base/random.h"
#include "simulation/render/caster.h"
#include "simulation/render/light_kernels.h"
#include "simulation/render/object_surfaces.h"
#include "simulation/render/texture_kernels.h"

namespace svnet::simulation {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr float kRoom_m = 0.4f;           // how far a ray into the room must be free
constexpr float kNext_m = 1e-4f;          // behind a clear surface
constexpr std::uint32_t kMostClear = 12;  // surfaces that a ray passes

/// The pixels of an image that are worked on together.
struct Pixels {
  std::size_t count = 0;
  Row<std::uint32_t> number, x, y;
  Row<std::uint32_t> words[4];  // random: where the samples lie, and which part of the lamps and the room each gets
  Rows3 radiance;
  Row<std::uint8_t> plain;  // 1: only the table was seen, without a shadow
};

/// Rays that are followed together.
struct Batch {
  std::size_t count = 0;
  Row<std::uint16_t> slot;          // of the ray's light
  Row<std::uint32_t> pixel, shift;  // shift: for stratify
  Rows3 origin, direction, share;   // share: of the light that passed clear surfaces
  Row<float> near;
  Caster::Hits hits;
};

/// Room for one thread's work on an image.
struct Work {
  Pixels pixels;
  Batch batch, next;
  CameraRays camera;
  Row<std::uint32_t> x, y, place, words[4];
  Row<float> numbers[4], meets, room_m;
  Surfaces surfaces;
  ObjectSurfaces object{};
  Angles angles;
  LightRays light_rays;
  Shading shading;
  Rows3 light;
  Row<std::uint8_t> plain;

  Work() { std::fill_n(room_m.at, kRays, kRoom_m); }
};

void draw_words(const ImageKey& key, std::uint32_t step, std::size_t count, const Row<std::uint32_t>& pixel,
                Row<std::uint32_t> (&words)[4]) {
  random_words_of_each(key.seed, Stream::collection, key.number, pixel.at, count, step,
                       {words[0].at, words[1].at, words[2].at, words[3].at});
}

void take_angles(std::size_t count, const Row<float> (&numbers)[4], Angles& angles) {
  constexpr float kTurn = 2 * std::numbers::pi_v<float>;
  for (std::size_t i = 0; i < count; ++i) {
    const float lamp = kTurn * numbers[1][i], room = kTurn * numbers[3][i];
    angles.lamp_sine[i] = std::sin(lamp), angles.lamp_cosine[i] = std::cos(lamp);
    angles.room_sine[i] = std::sin(room), angles.room_cosine[i] = std::cos(room);
  }
}

}  // namespace

struct Scene::Tracer {
  const Mesh* mesh;
  Setting setting;
  std::vector<LampPlace> lamps;
  ObjectPlace place;
  Eigen::AlignedBox3f bounds;
  Vec3 table_mean;
  bool any_clear = false;
  std::unique_ptr<Caster> caster;  // null: the table is empty

  /// The nearest surfaces: the object, or the table.
  void trace(Batch& batch, Row<float>& meets) const {
    find_table(batch.count, batch.origin, batch.direction, batch.near, batch.hits.distance);
    std::fill_n(batch.hits.triangle.at, batch.count, Caster::kNone);
    if (caster == nullptr) return;
    test_box(batch.count, bounds, batch.origin, batch.direction, batch.hits.distance, meets);
    Picked picked;
    for (std::size_t i = 0; i < batch.count; ++i)
      if (meets[i] != 0) picked.add(i);
    caster->nearest(picked, batch.origin, batch.direction, batch.near, batch.hits);
  }

  /// Lets through the share of light that the object does: `open` is 1 where it has to be looked at.
  void let_through(std::size_t count, const Rows3& start, const Rows3& direction, const Row<float>& far,
                   Row<float>& meets, Row<float>& open) const {
    if (caster == nullptr) return;
    test_box(count, bounds, start, direction, far, meets);
    Picked picked;
    for (std::size_t i = 0; i < count; ++i)
      if (open[i] != 0 && meets[i] != 0) picked.add(i);
    if (!any_clear) return caster->close_hidden(picked, start, direction, far, open);
    for (std::size_t k = 0; k < picked.count; ++k) {
      const std::size_t i = picked.at[k];
      open[i] = caster->passage(start.get(i), direction.get(i), far[i]);
    }
  }

  /// The room's light from a direction: the sky, the darker walls, the table below, and the lamps as bright spots that
  /// a rough surface smears.
  Vec3 surroundings(const Vec3& direction, float sharpness) const {
    if (direction.z() < 0) return table_mean;
    Vec3 light = setting.wall + (setting.sky - setting.wall) * std::min(1.0f, 1.4f * direction.z());
    // Windows: bright panels on the walls, which give metal and glass something to mirror.
    const float height = std::clamp(6 * (0.65f - std::abs(direction.z() - 0.4f) * 3), 0.0f, 1.0f);
    if (height > 0) {
      const float azimuth = std::atan2(direction.y(), direction.x());
      const float panel = std::clamp(4 * (std::cos(3 * azimuth) - 0.6f), 0.0f, 1.0f) * height;
      light += setting.sky * (0.7f * panel);
    }
    for (std::size_t i = 0; i < lamps.size(); ++i) {
      const float aligned = direction.dot(lamps[i].towards);
      if (aligned > 0)
        light += lamps[i].irradiance *
                 (std::pow(aligned, sharpness) * (sharpness + 2) / (2 * std::numbers::pi_v<float>)*0.35f);
    }
    return light;
  }

  /// Light that leaves a surface towards where the ray came from, with what it mirrors.
  Vec3 mirrored(const Material& material, bool is_metal, std::size_t i, const Vec3& direction, const Work& work) const {
    const Vec3 normal = work.surfaces.normal.get(i), colour = work.surfaces.colour.get(i);
    const float edge = work.shading.edge[i], seen = work.shading.seen[i];
    const Vec3 mirror = direction + 2 * work.shading.cosine[i] * normal;
    if (is_metal) {
      const Vec3 tint = colour + (Vec3::Ones() - colour) * edge;
      return tint.cwiseProduct(0.75f * surroundings(mirror, material.sharpness) * seen +
                               0.35f * work.shading.arriving.get(i));
    }
    Vec3 light = work.shading.scattered.get(i);
    const float reflected =
        material.gloss > 0 ? material.gloss + (1 - material.gloss) * edge * std::min(1.0f, material.sharpness / 60) : 0;
    if (reflected > 0) light += reflected * seen * surroundings(mirror, material.sharpness);
    return light;
  }

  /// Fills work.surfaces and work.object for the hits of a batch.
  void find_surfaces(const Batch& batch, Work& work) const {
    place_on_table(batch.count, batch.origin, batch.direction, batch.hits.distance, work.surfaces);
    paint(setting.table, batch.count, work.surfaces.point, work.surfaces.colour);
    std::fill_n(work.surfaces.clear.at, batch.count, setting.table.clear);
    work.object.picked.count = 0;
    if (caster == nullptr) return;
    for (std::size_t i = 0; i < batch.count; ++i)
      if (batch.hits.triangle[i] != Caster::kNone) work.object.picked.add(i);
    add_object_surfaces(*mesh, place, batch.origin, batch.direction, batch.hits, work.object, work.surfaces);
  }

  /// work.light, work.plain: the light along the rays of work.batch, through clear surfaces, and whether it comes from
  /// the table alone, without a shadow.
  void follow(Work& work, const ImageKey& key, std::uint32_t sample, std::uint32_t samples) const {
    Batch* batch = &work.batch;
    Batch* next = &work.next;
    const LampPlace& lamp = lamps[sample % lamps.size()];
    for (std::size_t i = 0; i < batch->count; ++i) {
      work.light.set(i, Vec3::Zero());
      work.plain[i] = batch->hits.triangle[i] == Caster::kNone;
    }
    for (std::uint32_t surfaces = 0; batch->count > 0; ++surfaces, std::swap(batch, next)) {
      const std::size_t count = batch->count;
      find_surfaces(*batch, work);
      draw_words(key, 3 + sample + 64 * surfaces, count, batch->pixel, work.words);
      stratify(count, sample, samples, batch->shift, work.words, work.numbers);
      take_angles(count, work.numbers, work.angles);
      make_light_rays(count, work.surfaces, lamp, work.numbers, work.angles, work.light_rays);
      LightRays& rays = work.light_rays;
      let_through(count, rays.start, rays.to_lamp, rays.lamp_distance, work.meets, rays.lit);
      let_through(count, rays.start, rays.to_room, work.room_m, work.meets, rays.open);
      shade(count, work.surfaces, batch->direction, rays, lamp, setting, table_mean, work.shading);
      add_mirrored(*batch, work);
      gather_light(*batch, work);
      next->count = 0;
      if (any_clear && surfaces < kMostClear) go_on(*batch, work, *next);
    }
  }

  /// Adds to work.shading.scattered what glossy and metal surfaces mirror.
  void add_mirrored(const Batch& batch, Work& work) const {
    const auto add = [&](const Material& material, bool is_metal, std::size_t i) {
      work.shading.scattered.set(i, mirrored(material, is_metal, i, batch.direction.get(i), work));
    };
    const ObjectSurfaces& object = work.object;
    for (std::size_t k = 0; k < object.picked.count; ++k)
      if (object.metal[k] != 0 || object.material[k]->gloss > 0)
        add(*object.material[k], object.metal[k] != 0, object.picked.at[k]);
    if (!setting.table.metal) return;
    for (std::size_t i = 0; i < batch.count; ++i)
      if (batch.hits.triangle[i] == Caster::kNone) add(setting.table, true, i);
  }

  void gather_light(const Batch& batch, Work& work) const {
    for (std::size_t i = 0; i < batch.count; ++i) {
      const std::size_t slot = batch.slot[i];
      const bool is_far = batch.hits.distance[i] == kFar;
      const Vec3 share = batch.share.get(i);
      work.light.set(slot,
                     work.light.get(slot) + share.cwiseProduct(is_far ? setting.wall : work.shading.scattered.get(i)));
      if (!is_far && work.shading.shadowed[i] != 0) work.plain[slot] = 0;
    }
  }

  /// Rays that go on behind clear surfaces, traced.
  void go_on(const Batch& batch, Work& work, Batch& next) const {
    for (std::size_t k = 0; k < work.object.picked.count; ++k) {
      const float clear = work.object.material[k]->clear;
      if (clear <= 0) continue;
      const std::size_t i = work.object.picked.at[k], to = next.count++;
      next.slot[to] = batch.slot[i], next.pixel[to] = batch.pixel[i], next.shift[to] = batch.shift[i];
      next.origin.set(to, batch.origin.get(i));
      next.direction.set(to, batch.direction.get(i));
      next.share.set(to, batch.share.get(i).cwiseProduct(work.surfaces.colour.get(i).cwiseSqrt()) * clear);
      next.near[to] = batch.hits.distance[i] + kNext_m;
    }
    trace(next, work.meets);
  }
};

Scene::Scene(const Mesh* mesh, const Eigen::Isometry3d& object_to_world, const Setting& setting)
    : tracer_(std::make_unique<Tracer>()) {
  Tracer& tracer = *tracer_;
  tracer.mesh = mesh;
  tracer.setting = setting;
  for (const Lamp& lamp : setting.lamps) tracer.lamps.emplace_back(lamp);
  tracer.table_mean = 0.5f * (setting.table.colour + setting.table.second);
  const Eigen::Affine3f placed(object_to_world.cast<float>().matrix());
  tracer.place = {placed.linear(), placed.inverse().matrix()};
  if (mesh == nullptr) return;
  for (const Material& material : mesh->materials) tracer.any_clear |= material.clear > 0;
  std::vector<Vec3> points;
  points.reserve(mesh->points.size());
  for (const Vec3& local : mesh->points) {
    points.emplace_back(placed * local);
    tracer.bounds.extend(points.back());
  }
  tracer.bounds.min().array() -= 1e-5f;
  tracer.bounds.max().array() += 1e-5f;
  tracer.caster = std::make_unique<Caster>(*mesh, points);
}

Scene::~Scene() = default;

Caster* Scene::caster() { return tracer_->caster.get(); }

Shot Scene::shoot(const view::Intrinsics& camera, const Eigen::Isometry3d& camera_to_world, const ImageKey& key,
                  int sample_count) const {
  check(sample_count == 1 || sample_count == 2 || sample_count == 4, "[render] ", sample_count,
        " samples per pixel; expected 1, 2 or 4");
  const auto samples = static_cast<std::uint32_t>(sample_count);
  constexpr std::uint32_t kPlainSamples = 2;  // are enough where only the bare table is seen
  Shot shot;
  shot.height = camera.height;
  shot.width = camera.width;
  const auto count = static_cast<std::size_t>(camera.height * camera.width);
  shot.radiance.resize(count);
  shot.depth = {camera.height, camera.width, std::vector<float>(count)};
  shot.mask.resize(count);
  const Vec3 origin = camera_to_world.translation().cast<float>();
  const Eigen::Matrix3f rotation = camera_to_world.linear().cast<float>();
  const auto work = std::make_unique<Work>();
  Pixels& pixels = work->pixels;
  Batch& batch = work->batch;

  const auto shoot_sample = [&](std::uint32_t sample) {
    batch.count = 0;
    for (std::size_t i = 0; i < pixels.count; ++i) {
      if (sample >= kPlainSamples && pixels.plain[i] != 0) continue;
      const std::size_t to = batch.count++;
      batch.slot[to] = static_cast<std::uint16_t>(to);
      work->place[to] = pixels.words[sample % 4][i];
      work->x[to] = pixels.x[i], work->y[to] = pixels.y[i];
      batch.pixel[to] = pixels.number[i], batch.shift[to] = pixels.words[0][i];
      batch.near[to] = 0;
      batch.origin.set(to, origin);
      batch.share.set(to, Vec3::Ones());
    }
    make_camera_rays(camera, rotation, batch.count, work->x, work->y, sample, work->place, work->camera);
    batch.direction = work->camera.direction;
    tracer_->trace(batch, work->meets);
    if (sample == 0)
      for (std::size_t i = 0; i < batch.count; ++i) {
        const float distance = batch.hits.distance[i];
        shot.depth.metres[batch.pixel[i]] = distance == kFar ? 0 : distance / work->camera.length[i];
        shot.mask[batch.pixel[i]] = batch.hits.triangle[i] != Caster::kNone ? 255 : 0;
      }
    tracer_->follow(*work, key, sample, samples);
    for (std::size_t i = 0, from = 0; i < pixels.count; ++i) {
      if (sample >= kPlainSamples && pixels.plain[i] != 0) continue;
      pixels.radiance.set(i, pixels.radiance.get(i) + work->light.get(from));
      pixels.plain[i] &= work->plain[from++];
    }
  };

  for (std::size_t first = 0; first < count; first += kRays) {
    pixels.count = std::min(kRays, count - first);
    for (std::size_t i = 0; i < pixels.count; ++i) {
      pixels.number[i] = static_cast<std::uint32_t>(first + i);
      pixels.y[i] = pixels.number[i] / static_cast<std::uint32_t>(camera.width);
      pixels.x[i] = pixels.number[i] - pixels.y[i] * static_cast<std::uint32_t>(camera.width);
      pixels.radiance.set(i, Vec3::Zero());
      pixels.plain[i] = 1;
    }
    draw_words(key, 2, pixels.count, pixels.number, pixels.words);
    for (std::uint32_t sample = 0; sample < samples; ++sample) shoot_sample(sample);
    for (std::size_t i = 0; i < pixels.count; ++i) {
      const std::uint32_t taken = pixels.plain[i] != 0 ? std::min(samples, kPlainSamples) : samples;
      shot.radiance[first + i] = pixels.radiance.get(i) / static_cast<float>(taken);
    }
  }
  return shot;
}

}  // namespace svnet::simulation
