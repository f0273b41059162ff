#include "nn/ops/dropout.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/random.h"
#include "nn/autograd.h"
#include "nn/numbers.h"

using namespace svnet;
using namespace svnet::test;

namespace {

double dropped_fraction(const Tensor& y) {
  double dropped = 0;
  for (float value : y.values<float>()) dropped += value == 0 ? 1 : 0;
  return dropped / static_cast<double>(y.size());
}

}  // namespace

TEST_CASE("dropout drops the given fraction of elements and scales the others") {
  constexpr Index kCount = 200000;
  const Tensor x = Tensor::full({kCount}, 3);
  for (double rate : {0.1, 0.5, 0.75}) {
    const Tensor y = ops::dropout(x, rate, {.seed = 1, .index = 2});
    // Five standard deviations of the binomial.
    CHECK(std::abs(dropped_fraction(y) - rate) < 5 * std::sqrt(rate * (1 - rate) / kCount));
    for (float value : y.values<float>())
      if (value != 0) REQUIRE(value == Approx(3 / (1 - rate)).epsilon(1e-6));
  }
}

TEST_CASE("dropout decides element e by word e of its stream") {
  const Tensor y = ops::dropout(Tensor::full({4099}, 1), 0.25, {.seed = 7, .index = 11});
  RandomStream words(7, Stream::dropout, 11);
  for (float value : y.values<float>()) REQUIRE((value == 0) == (words.bits32() < (1u << 30)));
}

TEST_CASE("dropout masks depend on the seed and on the index") {
  const Tensor x = Tensor::full({1000}, 1);
  const Tensor y = ops::dropout(x, 0.5, {.seed = 1, .index = 2});
  CHECK(same_bits(y, ops::dropout(x, 0.5, {.seed = 1, .index = 2})));
  CHECK_FALSE(same_bits(y, ops::dropout(x, 0.5, {.seed = 3, .index = 2})));
  CHECK_FALSE(same_bits(y, ops::dropout(x, 0.5, {.seed = 1, .index = 3})));
}

TEST_CASE("the backward pass of dropout uses the mask of the forward pass") {
  const Tensor x = Tensor::full({1003}, 1, DType::f64).as_parameter();
  const Tensor y = ops::dropout(x, 0.3, {.seed = 5, .index = 6});
  autograd::GradientMap gradients;
  autograd::backward(y, gradients, Tensor::full({1003}, 1, DType::f64));
  CHECK(same_bits(gradients.of(x), y.detached()));
}

TEST_CASE("dropout of rate 0 is the identity, and a dropped NaN becomes 0") {
  const Tensor x = random_tensor({10}, 1, DType::f32);
  CHECK(ops::dropout(x, 0, {}).data<float>() == x.data<float>());
  const Tensor y = ops::dropout(Tensor::full({1000}, std::nan("")), 0.5, {});
  CHECK(dropped_fraction(y) > 0.4);
}

TEST_CASE("dropout refuses other rates") {
  const Tensor x = Tensor::zeros({3});
  CHECK_THROWS_WITH(ops::dropout(x, 1, {}), "[dropout] rate must be in [0, 1), got 1");
  CHECK_THROWS_WITH(ops::dropout(x, -0.5, {}), "[dropout] rate must be in [0, 1), got -0.5");
}
