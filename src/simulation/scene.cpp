// Direct light of round lamps with soft shadows, one bounce of the room's light (sky, walls, table), highlights and
// mirrored surroundings. Shadows of lamps and room are sampled with one ray each per sample.
#include "simulation/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <embree3/rtcore.h>

#include "base/error.h"
#include "base/random.h"
#include "simulation/texture.h"

namespace svnet::simulation {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

/// Embree's device: one for the process, which builds on the calling thread alone, so that a tree does not depend on
/// how threads were scheduled.
RTCDevice device() {
  static const RTCDevice kDevice = [] {
    const RTCDevice created = rtcNewDevice("threads=1,user_threads=0");
    check(created != nullptr, "[render] Embree cannot be used: error ", static_cast<int>(rtcGetDeviceError(nullptr)));
    return created;
  }();
  return kDevice;
}

struct Hit {
  float distance = kFar;
  std::uint32_t triangle = RTC_INVALID_GEOMETRY_ID;
  float u = 0, v = 0;
  bool object() const { return triangle != RTC_INVALID_GEOMETRY_ID; }
};

/// Two axes that complete a unit vector to a basis (Duff et al., "Building an orthonormal basis, revisited", 2017).
std::pair<Vec3, Vec3> tangents(const Vec3& n) {
  const float sign = std::copysign(1.0f, n.z()), a = -1 / (sign + n.z()), b = n.x() * n.y() * a;
  return {Vec3(1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()), Vec3(b, sign + n.y() * n.y() * a, -n.y())};
}

/// Four uniform numbers in [0, 1).
std::array<float, 4> uniforms(const ImageKey& key, std::uint32_t pixel, std::uint32_t step) {
  const auto words = random_words(key.seed, Stream::collection, std::uint64_t{key.number} << 32 | pixel, step);
  std::array<float, 4> result{};
  for (std::size_t i = 0; i < 4; ++i) result[i] = static_cast<float>(words[i] >> 8) * 0x1p-24f;
  return result;
}

/// The random numbers that the samples of a pixel share: where in the pixel they lie, and which part of the lamps and
/// the room each gets.
struct PixelNumbers {
  std::array<std::uint32_t, 4> words;

  PixelNumbers(const ImageKey& key, std::uint32_t pixel)
      : words(random_words(key.seed, Stream::collection, std::uint64_t{key.number} << 32 | pixel, 2)) {}

  /// The first sample lies in the pixel's centre, the others at random places of its quarters.
  std::pair<float, float> place(std::uint32_t sample) const {
    if (sample == 0) return {0.0f, 0.0f};
    const std::uint32_t word = words[sample % 4];
    const auto part = [](std::uint32_t bits) { return static_cast<float>(bits & 0xffffu) * 0x1p-17f; };
    return {((sample & 1) != 0 ? 0.0f : -0.5f) + part(word), ((sample & 2) != 0 ? 0.0f : -0.5f) + part(word >> 16)};
  }
};

/// Four numbers in [0, 1), each in another of `samples` equal parts for each sample of a pixel (a Latin hypercube, with
/// strides that are coprime to powers of two), which takes most of the noise out of shadows.
std::array<float, 4> stratified(const ImageKey& key, const PixelNumbers& shared, std::uint32_t pixel,
                                std::uint32_t sample, std::uint32_t samples, std::uint32_t surfaces) {
  std::array<float, 4> result = uniforms(key, pixel, 3 + sample + 64 * surfaces);
  constexpr std::array<std::uint32_t, 4> kStride{1, 3, 1, 3};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::uint32_t part = (sample * kStride[i] + (shared.words[0] >> (8 * i))) % samples;
    result[i] = (static_cast<float>(part) + result[i]) / static_cast<float>(samples);
  }
  return result;
}

}  // namespace

struct Scene::Tracer {
  const Mesh* mesh;
  Setting setting;
  Eigen::Affine3f to_local;
  Eigen::Matrix3f to_world_rotation;
  Eigen::AlignedBox3f bounds;
  Vec3 table_mean;
  bool any_clear = false;
  RTCScene scene = nullptr;

  ~Tracer() {
    if (scene != nullptr) rtcReleaseScene(scene);
  }

  bool may_hit(const Vec3& origin, const Vec3& inverse, float far) const {
    const Vec3 a = (bounds.min() - origin).cwiseProduct(inverse), b = (bounds.max() - origin).cwiseProduct(inverse);
    const float enter = a.cwiseMin(b).maxCoeff(), leave = a.cwiseMax(b).minCoeff();
    return leave >= std::max(enter, 0.0f) && enter <= far;
  }

  static RTCRay ray_of(const Vec3& origin, const Vec3& direction, float near, float far) {
    RTCRay ray{};
    ray.org_x = origin.x(), ray.org_y = origin.y(), ray.org_z = origin.z();
    ray.dir_x = direction.x(), ray.dir_y = direction.y(), ray.dir_z = direction.z();
    ray.tnear = near;
    ray.tfar = far;
    ray.mask = ~0u;
    return ray;
  }

  /// The nearest surface of the object, or the table.
  Hit trace(const Vec3& origin, const Vec3& direction, float near) const {
    Hit hit;
    if (direction.z() < 0) hit.distance = -origin.z() / direction.z();
    if (hit.distance <= near) hit.distance = kFar;
    if (scene == nullptr || !may_hit(origin, direction.cwiseInverse(), hit.distance)) return hit;
    RTCRayHit query{};
    query.ray = ray_of(origin, direction, near, hit.distance);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
    return {query.ray.tfar, query.hit.primID, query.hit.u, query.hit.v};
  }

  /// The share of light that arrives along a ray of length `far`.
  float passage(Vec3 origin, const Vec3& direction, float near, float far) const {
    if (scene == nullptr || !may_hit(origin, direction.cwiseInverse(), far)) return 1;
    if (!any_clear) {
      RTCRay ray = ray_of(origin, direction, near, far);
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      rtcOccluded1(scene, &context, &ray);
      return ray.tfar < 0 ? 0.0f : 1.0f;
    }
    float share = 1;
    for (int surfaces = 0; surfaces < 16 && share > 0; ++surfaces) {
      RTCRayHit query{};
      query.ray = ray_of(origin, direction, near, far);
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      rtcIntersect1(scene, &context, &query);
      if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) break;
      const auto material = static_cast<std::size_t>(mesh->triangles[query.hit.primID].material);
      share *= mesh->materials[material].clear;
      near = query.ray.tfar + 1e-4f;
    }
    return share;
  }

  /// The room's light from a direction: the sky, the darker walls, the table below, and the lamps as bright spots that
  /// a rough surface smears.
  Vec3 surroundings(const Vec3& direction, float sharpness) const {
    if (direction.z() < 0) return table_mean;
    // Windows: bright panels on the walls, which give metal and glass something to mirror.
    const float azimuth = std::atan2(direction.y(), direction.x());
    const float panel = std::clamp(4 * (std::cos(3 * azimuth) - 0.6f), 0.0f, 1.0f) *
                        std::clamp(6 * (0.65f - std::abs(direction.z() - 0.4f) * 3), 0.0f, 1.0f);
    Vec3 light = setting.wall + (setting.sky - setting.wall) * std::min(1.0f, 1.4f * direction.z()) +
                 setting.sky * (0.7f * panel);
    for (const Lamp& lamp : setting.lamps) {
      const float aligned = direction.dot(lamp.place_m.normalized());
      if (aligned > 0)
        light +=
            lamp.irradiance * (std::pow(aligned, sharpness) * (sharpness + 2) / (2 * std::numbers::pi_v<float>)*0.35f);
    }
    return light;
  }

  struct Surface {
    Vec3 point, normal, geometric, colour;
    const Material* material;
    bool metal;
  };

  Surface surface(const Hit& hit, const Vec3& origin, const Vec3& direction) const {
    Surface s;
    s.point = origin + hit.distance * direction;
    if (!hit.object()) {
      s.point.z() = 0;
      s.normal = s.geometric = Vec3::UnitZ();
      s.material = &setting.table;
      s.metal = setting.table.metal;
      s.colour = surface_colour(setting.table, s.point, Vec2::Zero(), {});
      return s;
    }
    const Mesh::Triangle& triangle = mesh->triangles[hit.triangle];
    const auto& [na, nb, nc] = mesh->normals[hit.triangle];
    const Vec3 a = mesh->points[triangle.corner[0]], b = mesh->points[triangle.corner[1]],
               c = mesh->points[triangle.corner[2]];
    const float w = 1 - hit.u - hit.v;
    s.normal = (to_world_rotation * (w * na + hit.u * nb + hit.v * nc)).normalized();
    s.geometric = (to_world_rotation * (b - a).cross(c - a)).normalized();
    if (s.geometric.dot(direction) > 0) s.geometric = -s.geometric;
    if (s.normal.dot(s.geometric) < 0) s.normal = -s.normal;
    s.material = &mesh->materials[static_cast<std::size_t>(triangle.material)];
    const auto between = [&](const auto& corner) {
      return (w * corner[0] + hit.u * corner[1] + hit.v * corner[2]).eval();
    };
    const Vec2 uv = mesh->uv.empty() ? Vec2(0, 0) : between(mesh->uv[hit.triangle]);
    s.colour = surface_colour(*s.material, to_local * s.point, uv, mesh->images);
    if (!mesh->tints.empty()) s.colour = s.colour.cwiseProduct(between(mesh->tints[hit.triangle]));
    s.metal = mesh->metal_uv.empty() ? s.material->metal
                                     : is_metal(*s.material, between(mesh->metal_uv[hit.triangle]), mesh->images);
    return s;
  }

  /// Light that leaves the surface towards where the ray came from.
  /// `r`: where on the lamp, and where in the room. `shadowed` is set where either is hidden.
  Vec3 shade(const Surface& s, const Vec3& direction, const std::array<float, 4>& r, std::uint32_t sample,
             bool& shadowed) const {
    const Material& material = *s.material;
    const Vec3 start = s.point + 2e-4f * s.geometric;
    Vec3 arriving = Vec3::Zero();
    // One of the lamps, in turn, at a random point of its disc.
    const std::size_t lamps = setting.lamps.size();
    const Lamp& lamp = setting.lamps[sample % lamps];
    const auto [lx, ly] = tangents(lamp.place_m.normalized());
    const float lamp_radius = lamp.radius_m * std::sqrt(r[0]), lamp_angle = 2 * std::numbers::pi_v<float> * r[1];
    const Vec3 to_lamp = lamp.place_m + lamp_radius * (std::cos(lamp_angle) * lx + std::sin(lamp_angle) * ly) - s.point;
    const float distance = to_lamp.norm();
    const Vec3 towards = to_lamp / distance;
    const float facing = s.normal.dot(towards);
    float lit = 0;
    if (facing > 0 && s.geometric.dot(towards) > 0) {
      lit = passage(start, towards, 0, distance);
      const float nearer = lamp.place_m.squaredNorm() / (distance * distance);
      arriving += lamp.irradiance * (facing * lit * nearer * static_cast<float>(lamps));
    }
    // The room, from a direction drawn with the cosine.
    const auto [tx, ty] = tangents(s.normal);
    const float around = 2 * std::numbers::pi_v<float> * r[3], out = std::sqrt(r[2]);
    const Vec3 room = out * std::cos(around) * tx + out * std::sin(around) * ty + std::sqrt(1 - r[2]) * s.normal;
    const float open = s.geometric.dot(room) > 0 ? passage(start, room, 0, 0.4f) : 0.0f;
    const Vec3 from_room =
        room.z() >= 0 ? Vec3(setting.wall + (setting.sky - setting.wall) * room.z()) : Vec3(0.6f * table_mean);
    arriving += from_room * (0.25f + 0.75f * open);

    const float cosine = std::max(0.0f, -s.normal.dot(direction));
    const float rest = 1 - cosine, edge = rest * rest * rest * rest * rest;
    shadowed |= lit < 1 || open < 1;
    const Vec3 mirrored = direction + 2 * cosine * s.normal;
    const float seen = 0.35f + 0.65f * open;
    if (s.metal) {
      const Vec3 tint = s.colour + (Vec3::Ones() - s.colour) * edge;
      return tint.cwiseProduct(0.75f * surroundings(mirrored, material.sharpness) * seen + 0.35f * arriving);
    }
    const float reflected =
        material.gloss > 0 ? material.gloss + (1 - material.gloss) * edge * std::min(1.0f, material.sharpness / 60) : 0;
    Vec3 light = s.colour.cwiseProduct(arriving) * (1 - material.clear);
    if (reflected > 0 && (s.material != &setting.table))
      light += reflected * seen * surroundings(mirrored, material.sharpness);
    return light;
  }

  /// Light along a ray, through clear surfaces. `plain` is set where it comes from the table alone, without a shadow.
  Vec3 radiance(const Vec3& origin, const Vec3& direction, Hit hit, const ImageKey& key, const PixelNumbers& shared,
                std::uint32_t pixel, std::uint32_t sample, std::uint32_t samples, bool& plain) const {
    Vec3 light = Vec3::Zero(), share = Vec3::Ones();
    plain = !hit.object();
    for (std::uint32_t surfaces = 0;; ++surfaces) {
      if (hit.distance == kFar) return light + share.cwiseProduct(setting.wall);
      const Surface s = surface(hit, origin, direction);
      bool shadowed = false;
      light += share.cwiseProduct(
          shade(s, direction, stratified(key, shared, pixel, sample, samples, surfaces), sample, shadowed));
      plain &= !shadowed;
      if (!hit.object() || s.material->clear <= 0 || surfaces == 12) return light;
      share = share.cwiseProduct(s.colour.cwiseSqrt()) * s.material->clear;
      hit = trace(origin, direction, hit.distance + 1e-4f);
    }
  }
};

Scene::Scene(const Mesh* mesh, const Eigen::Isometry3d& object_to_world, const Setting& setting)
    : tracer_(std::make_unique<Tracer>()) {
  Tracer& tracer = *tracer_;
  tracer.mesh = mesh;
  tracer.setting = setting;
  tracer.table_mean = 0.5f * (setting.table.colour + setting.table.second);
  const Eigen::Affine3f placed(object_to_world.cast<float>().matrix());
  tracer.to_local = placed.inverse();
  tracer.to_world_rotation = placed.linear();
  if (mesh == nullptr) return;
  for (const Material& material : mesh->materials) tracer.any_clear |= material.clear > 0;

  tracer.scene = rtcNewScene(device());
  rtcSetSceneFlags(tracer.scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(tracer.scene, RTC_BUILD_QUALITY_MEDIUM);
  const RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                             3 * sizeof(float), mesh->points.size()));
  auto* corners = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), mesh->triangles.size()));
  check(points != nullptr && corners != nullptr, "[render] Embree has no memory for ", mesh->triangles.size(),
        " triangles");
  for (std::size_t i = 0; i < mesh->points.size(); ++i) {
    const Vec3 point = placed * mesh->points[i];
    tracer.bounds.extend(point);
    std::copy(point.data(), point.data() + 3, points + 3 * i);
  }
  for (std::size_t i = 0; i < mesh->triangles.size(); ++i)
    std::copy(mesh->triangles[i].corner.begin(), mesh->triangles[i].corner.end(), corners + 3 * i);
  tracer.bounds.min().array() -= 1e-5f;
  tracer.bounds.max().array() += 1e-5f;
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(tracer.scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(tracer.scene);
  const RTCError error = rtcGetDeviceError(device());
  check(error == RTC_ERROR_NONE, "[render] Embree cannot build the scene of ", mesh->triangles.size(),
        " triangles: error ", static_cast<int>(error));
}

Scene::~Scene() = default;

Shot Scene::shoot(const view::Intrinsics& camera, const Eigen::Isometry3d& camera_to_world, const ImageKey& key,
                  int samples) const {
  Shot shot;
  shot.height = camera.height;
  shot.width = camera.width;
  const auto count = static_cast<std::size_t>(camera.height * camera.width);
  shot.radiance.assign(count, Vec3::Zero());
  shot.depth = {camera.height, camera.width, std::vector<float>(count)};
  shot.mask.assign(count, 0);
  constexpr int kPlainSamples = 2;  // are enough where only the bare table is seen
  const Vec3 origin = camera_to_world.translation().cast<float>();
  const Eigen::Matrix3f rotation = camera_to_world.linear().cast<float>();
  for (Index y = 0; y < camera.height; ++y)
    for (Index x = 0; x < camera.width; ++x) {
      const auto pixel = static_cast<std::uint32_t>(y * camera.width + x);
      const PixelNumbers shared(key, pixel);
      int taken = 0;
      for (bool plain = true; taken < samples && !(plain && taken >= kPlainSamples); ++taken) {
        const auto sample = static_cast<std::uint32_t>(taken);
        const auto [dx, dy] = shared.place(sample);
        const Vec3 seen(static_cast<float>((static_cast<double>(x) + static_cast<double>(dx) - camera.cx) / camera.fx),
                        static_cast<float>((static_cast<double>(y) + static_cast<double>(dy) - camera.cy) / camera.fy),
                        1);
        const float length = seen.norm();
        const Vec3 direction = rotation * (seen / length);
        const Hit hit = tracer_->trace(origin, direction, 0);
        if (taken == 0) {
          shot.depth.metres[pixel] = hit.distance == kFar ? 0 : hit.distance / length;
          shot.mask[pixel] = hit.object() ? 255 : 0;
        }
        bool sample_plain = true;
        shot.radiance[pixel] += tracer_->radiance(origin, direction, hit, key, shared, pixel, sample,
                                                  static_cast<std::uint32_t>(samples), sample_plain);
        plain &= sample_plain;
      }
      shot.radiance[pixel] /= static_cast<float>(taken);
    }
  return shot;
}

}  // namespace svnet::simulation
