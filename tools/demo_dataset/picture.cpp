#include "demo_dataset/picture.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace svnet::demo {
namespace {

constexpr float kMissed = std::numeric_limits<float>::infinity();

/// A ball that holds the solid, in its own coordinates.
struct Ball {
  Vec3 centre;
  float radius;
};

/// How far along the ray (unit direction) the surface is; kMissed where it is not met.
float trace(const Solid& solid, const Ball& ball, const Vec3& origin, const Vec3& direction) {
  const Vec3 to_ball = ball.centre - origin;
  const float along = to_ball.dot(direction);
  const float half_squared = ball.radius * ball.radius - (to_ball - along * direction).squaredNorm();
  if (half_squared <= 0) return kMissed;
  const float half = std::sqrt(half_squared);
  float t = std::max(along - half, 0.0f);
  for (int step = 0; step < 200 && t < along + half; ++step) {
    const float d = solid.distance(origin + t * direction);
    if (d < 1e-4f) return t;
    t += d;
  }
  return kMissed;
}

Vec3 normal_at(const Solid& solid, const Vec3& p) {
  constexpr float kStep = 2e-4f;
  Vec3 gradient = Vec3::Zero();
  for (const Vec3& corner : {Vec3(1, -1, -1), Vec3(-1, -1, 1), Vec3(-1, 1, -1), Vec3(1, 1, 1)})
    gradient += corner * solid.distance(p + kStep * corner);
  return gradient.normalized();
}

/// The object and its light in the solid's own coordinates, in which all rays are traced.
struct Scene {
  const Solid& solid;
  Ball ball;
  Vec3 up;      // of the table
  float table;  // the table is where up · p = table
  Vec3 light;   // towards it

  Vec3 seen(const Vec3& origin, const Vec3& direction) const {
    const float t = trace(solid, ball, origin, direction);
    const float t_table = (table - up.dot(origin)) / up.dot(direction);  // every ray of the cameras goes down
    const bool on_solid = t < t_table;
    const Vec3 point = origin + std::min(t, t_table) * direction;
    const Vec3 normal = on_solid ? normal_at(solid, point) : up;
    const Vec3 albedo = on_solid ? solid.colour(point) : Vec3(0.80f, 0.77f, 0.72f);
    float bright = std::max(normal.dot(light), 0.0f);
    if (bright > 0 && trace(solid, ball, point + 1e-3f * normal, light) != kMissed) bright = 0;
    const float sky = 0.3f + 0.1f * normal.dot(up);
    return albedo * (sky + 0.65f * bright);
  }
};

}  // namespace

Placed put_down(const Solid& solid, const Eigen::Matrix3f& rotation) {
  constexpr int kCells = 60;
  constexpr float kReach = 0.16f;  // every solid fits into the cube of this half side
  const float cell = 2 * kReach / kCells;
  Vec3 low = Vec3::Constant(kMissed), high = -low;
  for (int i = 0; i < kCells * kCells * kCells; ++i) {
    const Eigen::Vector3i at(i % kCells, i / kCells % kCells, i / (kCells * kCells));
    const Vec3 p = (at.cast<float>().array() + 0.5f) * cell - kReach;
    if (solid.distance(rotation.transpose() * p) > 0.25f * cell) continue;
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec3 shift(0, 0, 0.25f * cell - low.z());
  return {solid, rotation, shift, (low + high) / 2 + shift, (high - low).norm()};
}

Image picture(const Placed& object, int theta_deg, int phi_deg, Index size) {
  constexpr float kDegree = std::numbers::pi_v<float> / 180, kFocal = 1.2f;  // of the picture's side
  const float theta = static_cast<float>(theta_deg) * kDegree, phi = static_cast<float>(phi_deg) * kDegree;
  const Vec3 outwards(std::cos(phi) * std::cos(theta), std::cos(phi) * std::sin(theta), std::sin(phi));
  const Vec3 right(-std::sin(theta), std::cos(theta), 0), up = outwards.cross(right);
  const Vec3 camera = object.centre + kFocal * object.diagonal / 0.7f * outwards;

  const Eigen::Matrix3f to_solid = object.rotation.transpose();
  const Ball ball{to_solid * (object.centre - object.shift), object.diagonal / 2};
  const Scene scene{object.solid, ball, to_solid.col(2), -object.shift.z(),
                    to_solid * Vec3(0.45f, -0.3f, 0.84f).normalized()};
  const Vec3 origin = to_solid * (camera - object.shift);
  Image image{size, size, {}};
  image.rgb.reserve(static_cast<std::size_t>(size * size * 3));
  for (Index y = 0; y < size; ++y)
    for (Index x = 0; x < size; ++x) {
      Vec3 sum = Vec3::Zero();
      for (int sample = 0; sample < 4; ++sample) {
        const float u = (static_cast<float>(2 * x + sample % 2) + 0.5f) / static_cast<float>(2 * size) - 0.5f;
        const float v = 0.5f - (static_cast<float>(2 * y + sample / 2) + 0.5f) / static_cast<float>(2 * size);
        sum += scene.seen(origin, to_solid * (u * right + v * up - kFocal * outwards).normalized());
      }
      for (int i = 0; i < 3; ++i) {
        const float value = std::sqrt(std::clamp(sum[i] / 4, 0.0f, 1.0f));  // a gamma of 2
        image.rgb.push_back(static_cast<std::uint8_t>(std::lround(255 * value)));
      }
    }
  return image;
}

}  // namespace svnet::demo
