#include "nn/ops/activations.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "nn/autograd.h"
#include "nn/numbers.h"
#include "nn/ops/losses.h"

using namespace svnet;
using namespace svnet::test;

namespace {

Tensor row(const std::vector<double>& values) {
  return Tensor::from(Shape{1, static_cast<Index>(values.size())}, values);
}

}  // namespace

TEST_CASE("activations at their kinks") {
  CHECK(same_bits(ops::relu(row({-1, 0, 2, 7})), row({0, 0, 2, 7})));
  CHECK(same_bits(ops::relu6(row({-1, 0, 2, 7})), row({0, 0, 2, 6})));
  CHECK(same_bits(ops::sigmoid(row({-1000, 0, 1000})), row({0, 0.5, 1})));
  CHECK(ops::sigmoid(row({-30})).item() == Approx(std::exp(-30)).epsilon(1e-12));
  CHECK(same_bits(ops::softmax(row({1000, 1000})), row({0.5, 0.5})));
  CHECK(same_bits(ops::softmax(row({-1000, 0})), row({0, 1})));
}

TEST_CASE("hard sigmoid and hard swish equal their formulas") {
  const auto hard = [](Activation kind, double x) { return ops::activation(row({x}), kind).item(); };
  for (double x : {-100.0, -3.0, -1.5, 0.0, 1.0, 3.0, 100.0}) {
    const double clamped = std::min(std::max(x + 3, 0.0), 6.0) / 6;
    CHECK(hard(Activation::hard_sigmoid, x) == Approx(clamped));
    CHECK(hard(Activation::hard_swish, x) == Approx(x * clamped));
  }
  CHECK(same_bits(ops::activation(row({-4, -3, 3, 4}), Activation::hard_swish), row({-0.0, -0.0, 3, 4})));
}

TEST_CASE("activations have names") {
  for (const auto& [value, name] : enum_names<Activation>) CHECK(enum_from_name<Activation>("x", name) == value);
  CHECK_THROWS_WITH(enum_from_name<Activation>("[activation]", "hardswish"),
                    Catch::Contains("'hardswish' is none of linear, relu") && Catch::Contains("'hard_swish'"));
}

TEST_CASE("the gradient at a kink is 0") {
  const Tensor x = row({0, 6}).as_parameter();
  autograd::GradientMap gradients;
  autograd::backward(ops::relu6(x), gradients, row({1, 1}));
  CHECK(same_bits(gradients.of(x), row({0, 0})));
  gradients.clear();
  autograd::backward(ops::relu(x), gradients, row({1, 1}));
  CHECK(same_bits(gradients.of(x), row({0, 1})));
}

TEST_CASE("NaN passes through activations and losses") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(ops::relu(row({nan})).item()));
  CHECK(std::isnan(ops::relu6(row({nan})).item()));
  CHECK(std::isnan(ops::sigmoid(row({nan})).item()));
  CHECK(std::isnan(ops::activation(row({nan}), Activation::hard_sigmoid).item()));
  CHECK(std::isnan(ops::activation(row({nan}), Activation::hard_swish).item()));
  for (const Tensor& x : {row({nan, 1, 2}), row({1, nan, 2}), row({1, 2, nan})}) {
    const Tensor softmax = ops::softmax(x);
    for (double p : softmax.values<double>()) CHECK(std::isnan(p));
    CHECK(std::isnan(ops::softmax_cross_entropy(x, {0}).item()));
    CHECK(std::isnan(ops::mean_squared_error(x, row({1, 1, 1})).item()));
  }
}

TEST_CASE("losses equal their formulas") {
  CHECK(ops::mean_squared_error(row({1, 2, 5}), row({1, 0, 2})).item() == Approx(13.0 / 3));
  const double expected = -std::log(std::exp(2.0) / (std::exp(1.0) + std::exp(2.0) + std::exp(-1.0)));
  CHECK(ops::softmax_cross_entropy(row({1, 2, -1}), {1}).item() == Approx(expected));
  CHECK(ops::softmax_cross_entropy(row({1000, 0}), {1}).item() == Approx(1000));  // no overflow
}
