#include "simulation/render/light_kernels.h"

#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simulation/render/light_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simulation/render/vector3-inl.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::simulation {
namespace HWY_NAMESPACE {

/// The product of a matrix and vectors, summed as Eigen does.
HWY_INLINE Floats3 turned(const Eigen::Matrix3f& m, const Floats3& v) {
  return {dot(same(m.row(0)), v), dot(same(m.row(1)), v), dot(same(m.row(2)), v)};
}

HWY_INLINE Floats3 cross(const Floats3& a, const Floats3& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

HWY_INLINE Floats3 normalized(const Floats3& v) {
  const Floats squared = dot(v, v);
  const Floats by = hn::IfThenElse(hn::Gt(squared, number(0)), hn::Sqrt(squared), number(1));
  return divided(v, by);
}

HWY_INLINE Floats3 negated_if(Which which, const Floats3& v) {
  return {hn::IfThenElse(which, hn::Neg(v.x), v.x), hn::IfThenElse(which, hn::Neg(v.y), v.y),
          hn::IfThenElse(which, hn::Neg(v.z), v.z)};
}

void make_camera_rays_here(const view::Intrinsics& camera, const Eigen::Matrix3f& rotation, std::size_t count,
                           const std::uint32_t* x, const std::uint32_t* y, std::uint32_t sample,
                           const std::uint32_t* word, CameraRays& rays) {
  const hn::CappedTag<double, 8> doubles;
  const hn::Rebind<float, decltype(doubles)> floats;
  const hn::Rebind<std::int32_t, decltype(doubles)> ints;
  const hn::Rebind<std::uint32_t, decltype(doubles)> words;
  const float left = (sample & 1) != 0 ? 0.0f : -0.5f, top = (sample & 2) != 0 ? 0.0f : -0.5f;
  const auto along = [&](hn::Vec<decltype(words)> pixel, hn::Vec<decltype(words)> bits, float corner, double centre,
                         double focal) {
    auto part = hn::Zero(floats);
    if (sample != 0) {
      const auto low = hn::And(bits, hn::Set(words, 0xffffu));
      part = hn::Add(hn::Set(floats, corner),
                     hn::Mul(hn::ConvertTo(floats, hn::BitCast(ints, low)), hn::Set(floats, 0x1p-17f)));
    }
    const auto place = hn::Add(hn::PromoteTo(doubles, hn::BitCast(ints, pixel)), hn::PromoteTo(doubles, part));
    return hn::DemoteTo(floats, hn::Div(hn::Sub(place, hn::Set(doubles, centre)), hn::Set(doubles, focal)));
  };
  for (std::size_t i = 0; i < count; i += hn::Lanes(doubles)) {
    const auto bits = hn::Load(words, word + i);
    hn::Store(along(hn::Load(words, x + i), bits, left, camera.cx, camera.fx), floats, rays.direction.x.at + i);
    hn::Store(along(hn::Load(words, y + i), hn::ShiftRight<16>(bits), top, camera.cy, camera.fy), floats,
              rays.direction.y.at + i);
  }
  for (std::size_t i = 0; i < count; i += hn::Lanes(FloatTag())) {
    const Floats3 seen{load(rays.direction.x, i), load(rays.direction.y, i), number(1)};
    const Floats length = norm(seen);
    store(length, rays.length, i);
    store(turned(rotation, divided(seen, length)), rays.direction, i);
  }
}

void find_table_here(std::size_t count, const Rows3& origin, const Rows3& direction, const Row<float>& near,
                     Row<float>& distance) {
  const Floats far = number(std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < count; i += hn::Lanes(FloatTag())) {
    const Floats down = load(direction.z, i), met = hn::Div(hn::Neg(load(origin.z, i)), down);
    const Which meets = hn::And(hn::Lt(down, number(0)), hn::Gt(met, load(near, i)));
    store(hn::IfThenElse(meets, met, far), distance, i);
  }
}

void test_box_here(std::size_t count, const Eigen::AlignedBox3f& box, const Rows3& origins, const Rows3& directions,
                   const Row<float>& far, Row<float>& meets) {
  const Floats3 low = same(box.min()), high = same(box.max());
  for (std::size_t i = 0; i < count; i += hn::Lanes(FloatTag())) {
    const Floats3 origin = load(origins, i), direction = load(directions, i);
    const Floats3 inverse{hn::Div(number(1), direction.x), hn::Div(number(1), direction.y),
                          hn::Div(number(1), direction.z)};
    const Floats3 a = product(low - origin, inverse), b = product(high - origin, inverse);
    const Floats enter = hn::Max(hn::Max(hn::Min(a.x, b.x), hn::Min(a.y, b.y)), hn::Min(a.z, b.z));
    const Floats leave = hn::Min(hn::Min(hn::Max(a.x, b.x), hn::Max(a.y, b.y)), hn::Max(a.z, b.z));
    store(hn::And(hn::Ge(leave, hn::Max(enter, number(0))), hn::Le(enter, load(far, i))), meets, i);
  }
}

void stratify_here(std::size_t count, std::uint32_t sample, std::uint32_t samples, const Row<std::uint32_t>& shift,
                   const Row<std::uint32_t> (&words)[4], Row<float> (&numbers)[4]) {
  const WordTag tag;
  const Words modulo = hn::Set(tag, samples - 1);
  const Floats parts = number(static_cast<float>(samples));
  for (std::size_t i = 0; i < count; i += hn::Lanes(tag)) {
    Words shifted = hn::Load(tag, shift.at + i);
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t stride = (k & 1) == 0 ? 1 : 3;
      const Words part = hn::And(hn::Add(hn::Set(tag, sample * stride), shifted), modulo);
      const Floats uniform = hn::Mul(from_words(hn::ShiftRight<8>(hn::Load(tag, words[k].at + i))), number(0x1p-24f));
      store(hn::Div(hn::Add(from_words(part), uniform), parts), numbers[k], i);
      shifted = hn::ShiftRight<8>(shifted);
    }
  }
}

void place_on_table_here(std::size_t count, const Rows3& origin, const Rows3& direction, const Row<float>& distance,
                         Surfaces& surfaces) {
  for (std::size_t i = 0; i < count; i += hn::Lanes(FloatTag())) {
    Floats3 point = load(origin, i) + scaled(load(distance, i), load(direction, i));
    point.z = number(0);
    store(point, surfaces.point, i);
    const Floats3 up{number(0), number(0), number(1)};
    store(up, surfaces.normal, i);
    store(up, surfaces.geometric, i);
  }
}

/// Two axes that complete unit vectors to a basis (Duff et al., "Building an orthonormal basis, revisited", 2017).
HWY_INLINE void tangents_of(const Floats3& n, Floats3& first, Floats3& second) {
  const Floats one = number(1), sign = hn::CopySign(one, n.z), a = hn::Div(number(-1), hn::Add(sign, n.z)),
               b = hn::Mul(hn::Mul(n.x, n.y), a);
  first = {hn::Add(one, hn::Mul(hn::Mul(hn::Mul(sign, n.x), n.x), a)), hn::Mul(sign, b), hn::Mul(hn::Neg(sign), n.x)};
  second = {b, hn::Add(sign, hn::Mul(hn::Mul(n.y, n.y), a)), hn::Neg(n.y)};
}

void make_light_rays_here(std::size_t count, const Surfaces& surfaces, const LampPlace& lamp,
                          const Row<float> (&numbers)[4], const Angles& angles, LightRays& rays) {
  const Floats zero = number(0);
  const Floats3 across = same(lamp.across), along = same(lamp.along), middle = same(lamp.place_m);
  for (std::size_t i = 0; i < count; i += hn::Lanes(FloatTag())) {
    const Floats3 point = load(surfaces.point, i), normal = load(surfaces.normal, i),
                  geometric = load(surfaces.geometric, i);
    store(point + scaled(number(2e-4f), geometric), rays.start, i);

    const Floats radius = hn::Mul(number(lamp.radius_m), hn::Sqrt(load(numbers[0], i)));
    const Floats3 on_disc = scaled(load(angles.lamp_cosine, i), across) + scaled(load(angles.lamp_sine, i), along);
    const Floats3 to_lamp = (middle + scaled(radius, on_disc)) - point;
    const Floats distance = norm(to_lamp);
    const Floats3 towards = divided(to_lamp, distance);
    const Floats facing = dot(normal, towards);
    store(towards, rays.to_lamp, i);
    store(distance, rays.lamp_distance, i);
    store(facing, rays.facing, i);
    store(hn::And(hn::Gt(facing, zero), hn::Gt(dot(geometric, towards), zero)), rays.lit, i);

    // The room, in a direction drawn with the cosine.
    Floats3 tx, ty;
    tangents_of(normal, tx, ty);
    const Floats share = load(numbers[2], i), out = hn::Sqrt(share);
    const Floats3 room =
        (scaled(hn::Mul(out, load(angles.room_cosine, i)), tx) + scaled(hn::Mul(out, load(angles.room_sine, i)), ty)) +
        scaled(hn::Sqrt(hn::Sub(number(1), share)), normal);
    store(room, rays.to_room, i);
    store(hn::Gt(dot(geometric, room), zero), rays.open, i);
  }
}

void shade_here(std::size_t count, const Surfaces& surfaces, const Rows3& direction, const LightRays& rays,
                const LampPlace& lamp, const Setting& setting, const Vec3& table_mean, Shading& shading) {
  const Floats zero = number(0), one = number(1);
  const Floats lamps = number(static_cast<float>(setting.lamps.size()));
  const Floats middle_squared = number(lamp.place_m.squaredNorm());
  const Floats3 irradiance = same(lamp.irradiance), wall = same(setting.wall),
                above = same(Vec3(setting.sky - setting.wall)), below = same(Vec3(0.6f * table_mean));
  for (std::size_t i = 0; i < count; i += hn::Lanes(FloatTag())) {
    const Floats3 normal = load(surfaces.normal, i);
    const Floats distance = load(rays.lamp_distance, i), facing = load(rays.facing, i), lit = load(rays.lit, i),
                 open = load(rays.open, i), rise = load(rays.to_room.z, i);
    // Where the lamp is hidden or behind the surface, `lit` is 0 and what it is multiplied by is finite.
    const Floats nearer = hn::Div(middle_squared, hn::Mul(distance, distance));
    const Floats from_lamp = hn::Mul(hn::Mul(hn::Mul(facing, lit), nearer), lamps);
    Floats3 arriving = scaled(hn::IfThenElseZero(hn::Gt(lit, zero), from_lamp), irradiance);
    const Which is_up = hn::Ge(rise, zero);
    const Floats3 higher = wall + scaled(rise, above);
    const Floats3 from_room{hn::IfThenElse(is_up, higher.x, below.x), hn::IfThenElse(is_up, higher.y, below.y),
                            hn::IfThenElse(is_up, higher.z, below.z)};
    arriving = arriving + scaled(hn::Add(number(0.25f), hn::Mul(number(0.75f), open)), from_room);
    store(arriving, shading.arriving, i);

    const Floats cosine = hn::Max(zero, hn::Neg(dot(normal, load(direction, i))));
    const Floats rest = hn::Sub(one, cosine);
    store(cosine, shading.cosine, i);
    store(hn::Mul(hn::Mul(hn::Mul(hn::Mul(rest, rest), rest), rest), rest), shading.edge, i);
    store(hn::Add(number(0.35f), hn::Mul(number(0.65f), open)), shading.seen, i);
    store(hn::Or(hn::Lt(lit, one), hn::Lt(open, one)), shading.shadowed, i);
    store(scaled(hn::Sub(one, load(surfaces.clear, i)), product(load(surfaces.colour, i), arriving)), shading.scattered,
          i);
  }
}

void finish_object_surfaces_here(std::size_t count, const Corners& corners, const Eigen::Matrix3f& to_world,
                                 const Eigen::Matrix4f& to_local, const Rows3& origins, const Rows3& directions,
                                 const Row<float>& distance, Surfaces& surfaces, Rows3& local) {
  const Floats zero = number(0);
  for (std::size_t i = 0; i < count; i += hn::Lanes(FloatTag())) {
    const Floats3 direction = load(directions, i);
    const Floats3 point = load(origins, i) + scaled(load(distance, i), direction);
    store(point, surfaces.point, i);
    const Floats u = load(corners.u, i), v = load(corners.v, i), w = hn::Sub(hn::Sub(number(1), u), v);
    const Floats3 between = (scaled(w, load(corners.normal_a, i)) + scaled(u, load(corners.normal_b, i))) +
                            scaled(v, load(corners.normal_c, i));
    Floats3 normal = normalized(turned(to_world, between));
    const Floats3 a = load(corners.a, i);
    Floats3 geometric = normalized(turned(to_world, cross(load(corners.b, i) - a, load(corners.c, i) - a)));
    geometric = negated_if(hn::Gt(dot(geometric, direction), zero), geometric);
    normal = negated_if(hn::Lt(dot(normal, geometric), zero), normal);
    store(normal, surfaces.normal, i);
    store(geometric, surfaces.geometric, i);
    const auto row = [&](int r) {
      const auto at = [&](int c) { return number(to_local(r, c)); };
      return hn::Add(hn::Add(hn::Add(hn::Mul(at(0), point.x), hn::Mul(at(1), point.y)), hn::Mul(at(2), point.z)),
                     at(3));
    };
    store(Floats3{row(0), row(1), row(2)}, local, i);
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace svnet::simulation
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::simulation {

HWY_EXPORT(make_camera_rays_here);
HWY_EXPORT(find_table_here);
HWY_EXPORT(test_box_here);
HWY_EXPORT(stratify_here);
HWY_EXPORT(place_on_table_here);
HWY_EXPORT(make_light_rays_here);
HWY_EXPORT(shade_here);
HWY_EXPORT(finish_object_surfaces_here);

void make_camera_rays(const view::Intrinsics& camera, const Eigen::Matrix3f& rotation, std::size_t count,
                      const Row<std::uint32_t>& x, const Row<std::uint32_t>& y, std::uint32_t sample,
                      const Row<std::uint32_t>& word, CameraRays& rays) {
  HWY_DYNAMIC_DISPATCH(make_camera_rays_here)(camera, rotation, count, x.at, y.at, sample, word.at, rays);
}

void find_table(std::size_t count, const Rows3& origin, const Rows3& direction, const Row<float>& near,
                Row<float>& distance) {
  HWY_DYNAMIC_DISPATCH(find_table_here)(count, origin, direction, near, distance);
}

void test_box(std::size_t count, const Eigen::AlignedBox3f& box, const Rows3& origin, const Rows3& direction,
              const Row<float>& far, Row<float>& meets) {
  HWY_DYNAMIC_DISPATCH(test_box_here)(count, box, origin, direction, far, meets);
}

void stratify(std::size_t count, std::uint32_t sample, std::uint32_t samples, const Row<std::uint32_t>& shift,
              const Row<std::uint32_t> (&words)[4], Row<float> (&numbers)[4]) {
  HWY_DYNAMIC_DISPATCH(stratify_here)(count, sample, samples, shift, words, numbers);
}

void place_on_table(std::size_t count, const Rows3& origin, const Rows3& direction, const Row<float>& distance,
                    Surfaces& surfaces) {
  HWY_DYNAMIC_DISPATCH(place_on_table_here)(count, origin, direction, distance, surfaces);
}

LampPlace::LampPlace(const Lamp& lamp)
    : place_m(lamp.place_m), irradiance(lamp.irradiance), towards(lamp.place_m.normalized()), radius_m(lamp.radius_m) {
  // The axes of tangents_of, for one vector.
  const Vec3& n = towards;
  const float sign = std::copysign(1.0f, n.z()), a = -1 / (sign + n.z()), b = n.x() * n.y() * a;
  across = Vec3(1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x());
  along = Vec3(b, sign + n.y() * n.y() * a, -n.y());
}

void make_light_rays(std::size_t count, const Surfaces& surfaces, const LampPlace& lamp, const Row<float> (&numbers)[4],
                     const Angles& angles, LightRays& rays) {
  HWY_DYNAMIC_DISPATCH(make_light_rays_here)(count, surfaces, lamp, numbers, angles, rays);
}

void shade(std::size_t count, const Surfaces& surfaces, const Rows3& direction, const LightRays& rays,
           const LampPlace& lamp, const Setting& setting, const Vec3& table_mean, Shading& shading) {
  HWY_DYNAMIC_DISPATCH(shade_here)(count, surfaces, direction, rays, lamp, setting, table_mean, shading);
}

void finish_object_surfaces(std::size_t count, const Corners& corners, const Eigen::Matrix3f& to_world_rotation,
                            const Eigen::Matrix4f& to_local, const Rows3& origin, const Rows3& direction,
                            const Row<float>& distance, Surfaces& surfaces, Rows3& local) {
  HWY_DYNAMIC_DISPATCH(finish_object_surfaces_here)
  (count, corners, to_world_rotation, to_local, origin, direction, distance, surfaces, local);
}

}  // namespace svnet::simulation
#endif
