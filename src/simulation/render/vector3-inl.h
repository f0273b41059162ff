// Vectors of many rays' numbers, and what Eigen does to three of them. Sums are taken in Eigen's order, so results have
// the bits of the same lines for one ray on every instruction set. Included once for each instruction set.
#if defined(SVNET_VECTOR3_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SVNET_VECTOR3_INL_H_
#undef SVNET_VECTOR3_INL_H_
#else
#define SVNET_VECTOR3_INL_H_
#endif

#include <hwy/highway.h>

#include "simulation/render/rays.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::simulation {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, 16>;
using IntTag = hn::Rebind<std::int32_t, FloatTag>;
using WordTag = hn::Rebind<std::uint32_t, FloatTag>;
using Floats = hn::Vec<FloatTag>;
using Ints = hn::Vec<IntTag>;
using Words = hn::Vec<WordTag>;
using Which = hn::Mask<FloatTag>;

HWY_INLINE Floats number(float value) { return hn::Set(FloatTag(), value); }
HWY_INLINE Floats load(const Row<float>& row, std::size_t i) { return hn::Load(FloatTag(), row.at + i); }
HWY_INLINE void store(Floats value, Row<float>& row, std::size_t i) { hn::Store(value, FloatTag(), row.at + i); }
/// 1 where `which`, else 0.
HWY_INLINE void store(Which which, Row<float>& row, std::size_t i) {
  store(hn::IfThenElseZero(which, number(1)), row, i);
}
/// The words as numbers; they must be below 2^31.
HWY_INLINE Floats from_words(Words words) { return hn::ConvertTo(FloatTag(), hn::BitCast(IntTag(), words)); }

struct Floats3 {
  Floats x, y, z;
};

HWY_INLINE Floats3 load(const Rows3& rows, std::size_t i) {
  return {load(rows.x, i), load(rows.y, i), load(rows.z, i)};
}
HWY_INLINE void store(const Floats3& value, Rows3& rows, std::size_t i) {
  store(value.x, rows.x, i), store(value.y, rows.y, i), store(value.z, rows.z, i);
}
HWY_INLINE Floats3 same(const Vec3& v) { return {number(v.x()), number(v.y()), number(v.z())}; }

HWY_INLINE Floats3 operator+(const Floats3& a, const Floats3& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Floats3 operator-(const Floats3& a, const Floats3& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Floats3 product(const Floats3& a, const Floats3& b) {
  return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)};
}
HWY_INLINE Floats3 scaled(Floats s, const Floats3& a) { return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)}; }
HWY_INLINE Floats3 divided(const Floats3& a, Floats by) {
  return {hn::Div(a.x, by), hn::Div(a.y, by), hn::Div(a.z, by)};
}
HWY_INLINE Floats dot(const Floats3& a, const Floats3& b) {
  return hn::Add(hn::Mul(a.x, b.x), hn::Add(hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)));
}
HWY_INLINE Floats norm(const Floats3& a) { return hn::Sqrt(dot(a, a)); }

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace svnet::simulation
HWY_AFTER_NAMESPACE();

#endif  // SVNET_VECTOR3_INL_H_
