#include "nn/layers/initializer.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "nn/numbers.h"

using namespace svnet;
using namespace svnet::test;

namespace {

struct Statistics {
  double mean = 0, variance = 0, largest = 0;
};

Statistics statistics(const Tensor& x) {
  Statistics s;
  for (double v : x.values<double>()) s.mean += v, s.largest = std::max(s.largest, std::abs(v));
  s.mean /= static_cast<double>(x.size());
  for (double v : x.values<double>()) s.variance += (v - s.mean) * (v - s.mean);
  s.variance /= static_cast<double>(x.size());
  return s;
}

}  // namespace

TEST_CASE("initialisers have Keras' variance and limits") {
  // 3x3 windows of 10 channels to 50: fan_in 90, fan_out 450. Dense 400 to 100. Features alone: fan_in = fan_out.
  const auto check_law = [](Initializer initializer, const Shape& shape, double variance) {
    const Tensor x = initialised(initializer, shape, 5, 1, DType::f64);
    const Statistics s = statistics(x);
    const bool normal = initializer == Initializer::glorot_normal || initializer == Initializer::he_normal ||
                        initializer == Initializer::lecun_normal;
    const double limit = normal ? 2 * std::sqrt(variance) / 0.87962566103423978 : std::sqrt(3 * variance);
    INFO("initialiser " << static_cast<int>(initializer) << ", " << to_string(shape));
    // Each bound is beyond five standard deviations of the estimate.
    CHECK(s.variance == Approx(variance).epsilon(5 * std::sqrt(1.0 / static_cast<double>(x.size()))));
    CHECK(std::abs(s.mean) < 5 * std::sqrt(variance / static_cast<double>(x.size())));
    CHECK(s.largest <= limit);
    CHECK(s.largest > 0.99 * limit);
  };
  const Shape convolution{3, 3, 10, 50}, dense{400, 100}, features{5000};
  for (auto glorot : {Initializer::glorot_uniform, Initializer::glorot_normal}) {
    check_law(glorot, convolution, 1.0 / 270);
    check_law(glorot, dense, 1.0 / 250);
    check_law(glorot, features, 1.0 / 5000);
  }
  for (auto he : {Initializer::he_uniform, Initializer::he_normal}) {
    check_law(he, convolution, 2.0 / 90);
    check_law(he, dense, 2.0 / 400);
  }
  for (auto lecun : {Initializer::lecun_uniform, Initializer::lecun_normal}) {
    check_law(lecun, convolution, 1.0 / 90);
    check_law(lecun, dense, 1.0 / 400);
  }
}

TEST_CASE("normal initialisers are truncated normals, not uniform") {
  const Tensor x = initialised(Initializer::lecun_normal, {1, 200000}, 5, 1, DType::f64);
  const double deviation = 1 / 0.87962566103423978;
  double inner = 0;
  for (double v : x.values<double>()) inner += std::abs(v) < deviation ? 1 : 0;
  // P(|z| < 1) / P(|z| < 2) of a standard normal.
  CHECK(inner / 200000 == Approx(0.682689492 / 0.954499736).margin(0.006));
}

TEST_CASE("initialisers depend on the seed and on the index of the parameter") {
  const auto drawn = [](std::uint64_t seed, std::uint32_t number) {
    return initialised(Initializer::he_normal, {40, 50}, seed, number);
  };
  CHECK(same_bits(drawn(1, 2), drawn(1, 2)));
  CHECK_FALSE(same_bits(drawn(1, 2), drawn(1, 3)));
  CHECK_FALSE(same_bits(drawn(1, 2), drawn(2, 2)));
  CHECK(same_bits(initialised(Initializer::zeros, {3}, 1, 2), Tensor::zeros({3})));
  CHECK(same_bits(initialised(Initializer::ones, {3}, 1, 2), Tensor::full({3}, 1)));
}

TEST_CASE("blocks of one large parameter use different random numbers") {
  const Tensor x = initialised(Initializer::he_uniform, {2, 1 << 14}, 1, 0, DType::f64);
  CHECK(x.data<double>()[0] != x.data<double>()[1 << 14]);
}
