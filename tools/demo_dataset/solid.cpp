#include "demo_dataset/solid.h"

#include <algorithm>
#include <cmath>

namespace svnet::demo {
namespace {

using Vec2 = Eigen::Vector2f;

/// Of a box with the given half sides around the origin.
float box(const Vec3& p, const Vec3& half) {
  const Vec3 q = p.cwiseAbs() - half;
  return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0f);
}

/// Of an upright cylinder from z = 0 to `height`.
float cylinder(const Vec3& p, float radius, float height) {
  const Vec2 q(p.head<2>().norm() - radius, std::abs(p.z() - height / 2) - height / 2);
  return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0f);
}

/// Of an upright cone frustum from radius r0 at z = 0 to r1 at `height`.
float frustum(const Vec3& p, float r0, float r1, float height) {
  const Vec2 q(p.head<2>().norm(), p.z());
  const Vec2 side(r1 - r0, height), from(q.x() - r0, q.y());
  const Vec2 to_side = from - side * std::clamp(from.dot(side) / side.squaredNorm(), 0.0f, 1.0f);
  const float radius = q.y() < height / 2 ? r0 : r1;
  const Vec2 to_cap(std::max(q.x() - radius, 0.0f), std::abs(q.y() - height / 2) - height / 2);
  const bool inside = side.y() * from.x() - side.x() * from.y() < 0 && to_cap.y() < 0;
  return (inside ? -1.0f : 1.0f) * std::sqrt(std::min(to_side.squaredNorm(), to_cap.squaredNorm()));
}

/// Of a ring around the y axis through the origin.
float ring(const Vec3& p, float radius, float thickness) {
  return Vec2(Vec2(p.x(), p.z()).norm() - radius, p.y()).norm() - thickness;
}

float without(float body, float hole) { return std::max(body, -hole); }

float uniform(RandomStream& random) { return static_cast<float>(random.uniform()); }

Vec3 random_colour(RandomStream& random) {
  const float red = uniform(random), green = uniform(random), blue = uniform(random);
  return Vec3(red, green, blue) * 0.75f + Vec3::Constant(0.1f);
}

}  // namespace

Solid::Solid(Category category, RandomStream& random)
    : category_(category),
      a_(uniform(random)),
      b_(uniform(random)),
      c_(uniform(random)),
      colours_{random_colour(random), random_colour(random)} {}

bool Solid::can_lie() const {
  return category_ == Category::bottle || category_ == Category::can || category_ == Category::mug;
}

Eigen::Vector2f Solid::parts(const Vec3& p) const {
  const Vec3 up = Vec3::UnitZ();
  const float radius = 0.03f + 0.015f * a_;
  if (category_ == Category::bottle) {
    const float body = 0.06f + 0.03f * b_, shoulder = 0.02f + 0.015f * c_, neck = 0.01f + 0.004f * a_;
    return {std::min(cylinder(p, radius, body), frustum(p - body * up, radius, neck, shoulder)),
            cylinder(p - (body + shoulder) * up, neck, 0.025f)};
  }
  if (category_ == Category::bowl) {
    const float size = 0.045f + 0.02f * a_, depth = size * (0.6f + 0.3f * b_);
    const Vec3 q = p - size * up;
    const float shell = std::abs(q.norm() - size) - 0.003f;
    return {std::max(shell, p.z() - depth), cylinder(p, 0.4f * size, 0.006f)};
  }
  if (category_ == Category::box) {
    const Vec3 half(0.03f + 0.03f * a_, 0.02f + 0.02f * b_, 0.015f + 0.03f * c_);
    const Vec3 q = p - half.z() * up;
    return {box(q, half), box(q, Vec3(half.x() + 0.001f, 0.3f * half.y(), half.z() + 0.001f))};  // a ribbon
  }
  if (category_ == Category::can) {
    const float height = 0.06f + 0.05f * b_;
    const float hole = cylinder(p - (height - 0.004f) * up, radius - 0.004f, 0.01f);
    return {cylinder(p, radius, 0.85f * height), without(cylinder(p, radius - 0.002f, height), hole)};
  }
  if (category_ == Category::cone) {
    const float height = 0.07f + 0.05f * b_;
    return {frustum(p - 0.006f * up, radius, 0.004f, height), cylinder(p, radius + 0.004f, 0.006f)};
  }
  if (category_ == Category::hammer) {
    const float length = 0.06f + 0.02f * a_, thickness = 0.008f + 0.003f * b_;
    const Vec3 head(0.012f + 0.004f * c_, 0.03f + 0.01f * b_, 0.012f);
    const Vec3 lying(p.z() - 0.012f, p.y(), p.x() + length);  // the handle's axis, x, becomes the cylinder's z
    return {cylinder(lying, thickness, 2 * length), box(p - Vec3(length, 0, 0.012f), head)};
  }
  if (category_ == Category::mug) {
    const float height = 0.06f + 0.035f * b_;
    const float cup = without(cylinder(p, radius, height), cylinder(p - 0.006f * up, radius - 0.004f, height));
    const float handle = ring(p - Vec3(radius, 0, height / 2), 0.018f + 0.008f * c_, 0.005f);
    return {cup, without(handle, cylinder(p, radius - 0.002f, height))};
  }
  // A plate: a flat bottom and a rim that rises.
  const float size = 0.05f + 0.02f * a_, rise = 0.008f + 0.006f * b_;
  const float bowl = frustum(p, 0.6f * size, size, rise);
  return {without(bowl, frustum(p - 0.004f * up, 0.6f * size, size, rise)), cylinder(p, 0.35f * size, 0.0055f)};
}

float Solid::distance(const Vec3& p) const { return parts(p).minCoeff(); }

const Vec3& Solid::colour(const Vec3& p) const {
  const Eigen::Vector2f d = parts(p);
  return colours_[d[1] < d[0]];
}

}  // namespace svnet::demo
