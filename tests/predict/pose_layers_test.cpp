#include "predict/pose_layers.h"

#include <catch2/catch.hpp>

#include "base/random.h"
#include "nn/kernels/packed/bf16_tile.h"
#include "small_model.h"

using namespace svnet;
using namespace svnet::predict;

namespace {

Tensor random_tensor(Shape shape, double scale, std::uint64_t seed) {
  RandomStream random(seed, Stream::weights);
  Tensor result = Tensor::empty(std::move(shape));
  for (Index i = 0; i < result.size(); ++i)
    result.data<float>()[i] = static_cast<float>(scale * (2 * random.uniform() - 1));
  return result;
}

/// Layers whose units depend on the angles with `strength` times their random size.
SplitGraph layers(models::AngleEncoding angles, double strength, Index units = 40, Index hidden = 21) {
  return {.once = {},
          .angle_kernel = random_tensor({models::angle_count(angles), units}, strength, 1),
          .kernel = random_tensor({units, hidden}, 0.5, 2),
          .bias = random_tensor({hidden}, 1, 3),
          .layer = "layer",
          .last_kernel = random_tensor({hidden, 2}, 0.5, 4),
          .last_bias = random_tensor({2}, 1, 5),
          .rest = {}};
}

std::vector<float> encoded_poses(models::AngleEncoding encoding, Index count) {
  const Index size = models::angle_count(encoding);
  std::vector<float> angles(static_cast<std::size_t>(count * size));
  for (Index i = 0; i < count; ++i) {
    const double turn = static_cast<double>(i) / static_cast<double>(count);
    models::encode_angles(encoding, 359.9 * turn, i == 0 ? 0 : i == 1 ? 90 : 90 * (1 - turn), angles.data() + i * size);
  }
  return angles;
}

/// z by the definition, in f64.
double expected(const SplitGraph& s, const float* c, const float* angles, Index output) {
  const Index units = s.kernel.dim(0), hidden = s.kernel.dim(1);
  double z = s.last_bias.data<float>()[output];
  for (Index i = 0; i < hidden; ++i) {
    double y = s.bias.data<float>()[i];
    for (Index unit = 0; unit < units; ++unit) {
      double h = c[unit];
      for (Index k = 0; k < s.angle_kernel.dim(0); ++k)
        h += static_cast<double>(angles[k]) * s.angle_kernel.data<float>()[k * units + unit];
      y += std::max(h, 0.0) * s.kernel.data<float>()[unit * hidden + i];
    }
    z += std::max(y, 0.0) * s.last_kernel.data<float>()[i * 2 + output];
  }
  return z;
}

std::vector<float> outputs_of(const PoseLayers& layers, const PoseLayers::Picture& picture, Index poses,
                              const float* angles) {
  std::vector<float> z(static_cast<std::size_t>(poses * layers.outputs()));
  PoseLayers::Buffers buffers;
  layers.run(picture, poses, angles, z.data(), buffers);
  return z;
}

/// How many elements may change their sign.
struct Changing {
  std::size_t units, columns;
};

double largest_error(const SplitGraph& split, models::AngleEncoding encoding, const InferenceOptions& options,
                     Changing* changing = nullptr) {
  const PoseLayers layers(split, encoding, options);
  PoseLayers::Picture picture;
  const auto angles = encoded_poses(encoding, 50);
  double largest = 0;
  for (std::uint64_t seed = 10; seed < 13; ++seed) {  // one after the other in the same memory
    const Tensor c = random_tensor({split.kernel.dim(0)}, 1, seed);
    layers.set_picture(c.data<float>(), picture);
    if (changing) *changing = {picture.units.size(), picture.columns.size()};
    const auto z = outputs_of(layers, picture, 50, angles.data());
    for (Index pose = 0; pose < 50; ++pose)
      for (Index i = 0; i < layers.outputs(); ++i)
        largest = std::max(largest, std::abs(z[static_cast<std::size_t>(pose * layers.outputs() + i)] -
                                             expected(split, c.data<float>(),
                                                      angles.data() + pose * models::angle_count(encoding), i)));
  }
  return largest;
}

}  // namespace

TEST_CASE("layers of a pose agree with their definition, however many units change their sign") {
  using enum models::AngleEncoding;
  int few_columns = 0;
  for (const models::AngleEncoding encoding : {radians, sphere, harmonics}) {
    Changing none{}, some{}, all{};
    CHECK(largest_error(layers(encoding, 0), encoding, {}, &none) < 1e-5);
    CHECK(largest_error(layers(encoding, 0.03), encoding, {}, &some) < 1e-5);
    CHECK(largest_error(layers(encoding, 50), encoding, {}, &all) < 5e-3);  // values near 5,000
    CHECK(none.units + none.columns == 0);
    few_columns += some.columns > 0 && some.columns < 21;
    CHECK(all.units > some.units);
    CHECK(all.columns > 15);
  }
  CHECK(few_columns > 0);
}

TEST_CASE("layers of a pose round their weights as the precision says") {
  // Weights that int8 holds: whole numbers of a step, the largest of each column being 127 steps.
  SplitGraph split = layers(models::AngleEncoding::radians, 0.1, 80, 64);
  for (Index i = 0; i < split.kernel.size(); ++i) {
    float& w = split.kernel.data<float>()[i];
    w = i < 64 ? 127.0f / 128 : std::round(w * 127) / 128;
  }
  CHECK(largest_error(split, models::AngleEncoding::radians, {.int8_dense = true}) < 2e-5);
  if (kernels::machine_has_bf16())
    CHECK(largest_error(split, models::AngleEncoding::radians, {.precision = kernels::Precision::bf16}) < 0.1);
}

TEST_CASE("what a pose gives does not depend on the other poses") {
  const SplitGraph split = layers(models::AngleEncoding::sphere, 0.2);
  const PoseLayers layers(split, models::AngleEncoding::sphere, {});
  PoseLayers::Picture picture;
  layers.set_picture(random_tensor({40}, 1, 5).data<float>(), picture);
  const auto angles = encoded_poses(models::AngleEncoding::sphere, 33);
  const auto together = outputs_of(layers, picture, 33, angles.data());
  for (Index pose = 0; pose < 33; ++pose) {
    const auto alone = outputs_of(layers, picture, 1, angles.data() + 3 * pose);
    CHECK(std::equal(alone.begin(), alone.end(), together.begin() + pose * layers.outputs()));
  }
}

TEST_CASE("a unit that is not a number makes the outputs so") {
  const SplitGraph split = layers(models::AngleEncoding::radians, 0.1);
  const PoseLayers layers(split, models::AngleEncoding::radians, {});
  Tensor c = random_tensor({40}, 1, 5);
  c.data<float>()[7] = std::nanf("");
  PoseLayers::Picture picture;
  layers.set_picture(c.data<float>(), picture);
  const auto angles = encoded_poses(models::AngleEncoding::radians, 3);
  for (const float y : outputs_of(layers, picture, 3, angles.data())) CHECK(std::isnan(y));
}
