#include "simulation/render/texture_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simulation/render/texture_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simulation/render/vector3-inl.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::simulation {
namespace HWY_NAMESPACE {

/// The last steps of the hash of lattice points to [0, 1).
HWY_INLINE Floats lattice_value(Words h) {
  const WordTag tag;
  h = hn::Mul(hn::Xor(h, hn::ShiftRight<15>(h)), hn::Set(tag, 0x2c1b3c6du));
  h = hn::Mul(hn::Xor(h, hn::ShiftRight<12>(h)), hn::Set(tag, 0x297a2d39u));
  return hn::Mul(from_words(hn::ShiftRight<8>(hn::Xor(h, hn::ShiftRight<15>(h)))), number(0x1p-24f));
}

HWY_INLINE Floats mixed(Floats a, Floats b, Floats t) { return hn::Add(a, hn::Mul(t, hn::Sub(b, a))); }

/// One coordinate of the lattice: its share of the hash below and above, and the smoothed place between.
struct LatticeAxis {
  Words below, above;
  Floats place;
};

HWY_INLINE LatticeAxis lattice_axis(Floats p, std::uint32_t factor) {
  const WordTag tag;
  const Floats floored = hn::Floor(p), f = hn::Sub(p, floored);
  const Words times = hn::Set(tag, factor), below = hn::Mul(hn::BitCast(tag, hn::ConvertTo(IntTag(), floored)), times);
  return {below, hn::Add(below, times), hn::Mul(hn::Mul(f, f), hn::Sub(number(3), hn::Mul(number(2), f)))};
}

/// Value noise in [0, 1), one detail per unit.
HWY_INLINE Floats value_noise(Floats px, Floats py, Floats pz) {
  const LatticeAxis x = lattice_axis(px, 0x8da6b343u), y = lattice_axis(py, 0xd8163841u),
                    z = lattice_axis(pz, 0xcb1ab31fu);
  const auto row = [&](Words of_y, Words of_z) {
    const Words rest = hn::Xor(of_y, of_z);
    return mixed(lattice_value(hn::Xor(x.below, rest)), lattice_value(hn::Xor(x.above, rest)), x.place);
  };
  return mixed(mixed(row(y.below, z.below), row(y.above, z.below), y.place),
               mixed(row(y.below, z.above), row(y.above, z.above), y.place), z.place);
}

HWY_INLINE Floats scaled_noise(const Floats3& p, float x, float y, float z) {
  return value_noise(hn::Mul(number(x), p.x), hn::Mul(number(y), p.y), hn::Mul(number(z), p.z));
}

HWY_INLINE Floats fraction(Floats x) { return hn::Sub(x, hn::Floor(x)); }

/// The share of the material's second colour.
template <Texture texture>
HWY_INLINE Floats second_share(const Floats3& p) {
  const Floats zero = number(0), one = number(1);
  if constexpr (texture == Texture::wood) {  // rings around an axis near x
    const Floats rings =
        hn::Add(hn::Add(p.y, hn::Mul(number(0.7f), p.z)), hn::Mul(number(1.5f), scaled_noise(p, 0.12f, 0.5f, 0.5f)));
    return hn::Add(hn::Mul(number(0.6f), fraction(rings)), hn::Mul(number(0.4f), scaled_noise(p, 0.6f, 6, 6)));
  } else if constexpr (texture == Texture::brushed) {
    return scaled_noise(p, 0.1f, 4, 4);
  } else if constexpr (texture == Texture::speckled) {
    return hn::Add(hn::Mul(number(0.6f), value_noise(p.x, p.y, p.z)),
                   hn::Mul(number(0.4f), scaled_noise(p, 2.7f, 2.7f, 2.7f)));
  } else if constexpr (texture == Texture::stripes) {
    const Floats along = hn::Sub(p.x, hn::Mul(number(2), hn::Floor(hn::Div(p.x, number(2)))));
    return hn::IfThenElse(hn::Lt(along, one), zero, one);
  } else {
    static_assert(texture == Texture::checks);
    const Floats x = fraction(p.x), y = fraction(p.y);
    const Floats edge = hn::Min(hn::Min(x, y), hn::Min(hn::Sub(one, x), hn::Sub(one, y)));
    return hn::IfThenElse(hn::Lt(edge, number(0.04f)), one, hn::Mul(number(0.25f), scaled_noise(p, 6, 6, 6)));
  }
}

template <Texture texture>
HWY_INLINE void paint_with(const Material& material, std::size_t count, const Rows3& local, Rows3& colour) {
  const Floats3 first = same(material.colour), difference = same(Vec3(material.second - material.colour));
  const Floats scale = number(material.scale_m);
  for (std::size_t i = 0; i < count; i += hn::Lanes(FloatTag()))
    store(first + scaled(second_share<texture>(divided(load(local, i), scale)), difference), colour, i);
}

void paint_here(const Material& material, std::size_t count, const Rows3& local, Rows3& colour) {
  switch (material.texture) {
    case Texture::wood:
      return paint_with<Texture::wood>(material, count, local, colour);
    case Texture::brushed:
      return paint_with<Texture::brushed>(material, count, local, colour);
    case Texture::speckled:
      return paint_with<Texture::speckled>(material, count, local, colour);
    case Texture::stripes:
      return paint_with<Texture::stripes>(material, count, local, colour);
    case Texture::checks:
      return paint_with<Texture::checks>(material, count, local, colour);
    case Texture::plain:
    case Texture::image:
      break;
  }
  for (std::size_t i = 0; i < count; ++i) colour.set(i, material.colour);
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace svnet::simulation
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::simulation {

HWY_EXPORT(paint_here);

void paint(const Material& material, std::size_t count, const Rows3& local_m, Rows3& colour) {
  HWY_DYNAMIC_DISPATCH(paint_here)(material, count, local_m, colour);
}

}  // namespace svnet::simulation
#endif
