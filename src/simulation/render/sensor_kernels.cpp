#include "simulation/render/sensor_kernels.h"

#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simulation/render/sensor_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simulation/render/vector3-inl.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::simulation {
namespace HWY_NAMESPACE {

/// To the nearest whole number, halves up.
HWY_INLINE Floats to_nearest(Floats x) {
  const Floats below = hn::Floor(x);
  return hn::Add(below, hn::IfThenElseZero(hn::Ge(hn::Sub(x, below), number(0.5f)), number(1)));
}

void make_polar_here(std::size_t count, const Row<std::uint32_t> (&words)[4], PolarDraw& draw) {
  const WordTag tag;
  for (std::size_t pair = 0; pair < 2; ++pair)
    for (std::size_t i = 0; i < count; i += hn::Lanes(tag)) {
      const auto upper = [&](std::size_t word) {
        return from_words(hn::ShiftRight<8>(hn::Load(tag, words[word].at + i)));
      };
      store(hn::Mul(hn::Add(upper(2 * pair), number(1)), number(0x1p-24f)), draw.uniform[pair], i);
      store(hn::Mul(hn::Mul(number(2 * std::numbers::pi_v<float>), upper(2 * pair + 1)), number(0x1p-24f)),
            draw.angle[pair], i);
    }
}

HWY_INLINE Floats polar_radius(const PolarValues& values, std::size_t pair, std::size_t i) {
  return hn::Sqrt(hn::Mul(number(-2), load(values.log[pair], i)));
}

void develop_here(std::size_t count, const PolarValues& values, const Rows3& light, float exposure, const float* srgb,
                  std::size_t steps, Row<std::int32_t> (&levels)[3]) {
  constexpr float kShotNoise = 0.0003f, kReadNoise = 0.0016f;  // variance per light, and σ in the dark
  const Floats zero = number(0), one = number(1), last = number(static_cast<float>(steps));
  const auto level = [&](Floats value, Floats noise) {
    value = hn::Mul(number(exposure), value);
    const Floats sigma =
        hn::Sqrt(hn::Add(hn::Mul(number(kShotNoise), hn::Max(value, zero)), number(kReadNoise * kReadNoise)));
    const Floats noisy = hn::Min(hn::Max(hn::Add(value, hn::Mul(sigma, noise)), zero), one);
    const Floats place = hn::Mul(hn::Sqrt(noisy), last);
    const Ints below = hn::ConvertTo(IntTag(), place);
    const Floats low = hn::GatherIndex(FloatTag(), srgb, below), high = hn::GatherIndex(FloatTag(), srgb + 1, below);
    const Floats part = hn::Sub(place, hn::ConvertTo(FloatTag(), below));
    return hn::ConvertTo(IntTag(), to_nearest(hn::Add(low, hn::Mul(part, hn::Sub(high, low)))));
  };
  for (std::size_t i = 0; i < count; i += hn::Lanes(FloatTag())) {
    const Floats first = polar_radius(values, 0, i), second = polar_radius(values, 1, i);
    hn::Store(level(load(light.x, i), hn::Mul(first, load(values.cosine[0], i))), IntTag(), levels[0].at + i);
    hn::Store(level(load(light.y, i), hn::Mul(first, load(values.sine[0], i))), IntTag(), levels[1].at + i);
    hn::Store(level(load(light.z, i), hn::Mul(second, load(values.cosine[1], i))), IntTag(), levels[2].at + i);
  }
}

void measure_depth_here(std::size_t count, const PolarValues& values, const Row<float>& z_m, Row<float>& measured_m) {
  constexpr float kDepthNoise = 0.0014f;
  for (std::size_t i = 0; i < count; i += hn::Lanes(FloatTag())) {
    const Floats z = load(z_m, i), noise = hn::Mul(polar_radius(values, 1, i), load(values.sine[1], i));
    const Floats moved = hn::Add(z, hn::Mul(hn::Mul(hn::Mul(number(kDepthNoise), z), z), noise));
    const Floats mm = to_nearest(hn::Mul(number(1000), moved));
    store(hn::Max(number(0), hn::Div(mm, number(1000))), measured_m, i);
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace svnet::simulation
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::simulation {

HWY_EXPORT(make_polar_here);
HWY_EXPORT(develop_here);
HWY_EXPORT(measure_depth_here);

void make_polar(std::size_t count, const Row<std::uint32_t> (&words)[4], PolarDraw& draw) {
  HWY_DYNAMIC_DISPATCH(make_polar_here)(count, words, draw);
}

void develop(std::size_t count, const PolarValues& values, const Rows3& light, float exposure,
             std::span<const float> srgb, Row<std::int32_t> (&levels)[3]) {
  HWY_DYNAMIC_DISPATCH(develop_here)(count, values, light, exposure, srgb.data(), srgb.size() - 2, levels);
}

void measure_depth(std::size_t count, const PolarValues& values, const Row<float>& z_m, Row<float>& measured_m) {
  HWY_DYNAMIC_DISPATCH(measure_depth_here)(count, values, z_m, measured_m);
}

}  // namespace svnet::simulation
#endif
