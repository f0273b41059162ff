#include "nn/ops/batch_norm.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "nn/numbers.h"

using namespace svnet;
using namespace svnet::test;

namespace {

// Column 0 has mean 3 and biased variance 5 (unbiased 20/3), column 1 mean −1 and biased variance 1 (unbiased 4/3).
const std::vector<double> kRows{0, -2, 2, 0, 4, -2, 6, 0};

Tensor pair(double a, double b) { return Tensor::from<double>({2}, std::vector<double>{a, b}); }

void check_pair(const Tensor& x, double a, double b) {
  CHECK(x.data<double>()[0] == Approx(a).epsilon(1e-14));
  CHECK(x.data<double>()[1] == Approx(b).epsilon(1e-14));
}

struct Result {
  Tensor y, mean, variance;
};

Result trained(const Shape& shape, const BatchNormOptions& options) {
  Result r{{}, pair(10, 20), pair(2, 4)};
  r.y = ops::batch_norm_training(Tensor::from(shape, kRows), pair(2, 3), pair(0.5, -0.5), r.mean, r.variance, options);
  return r;
}

}  // namespace

TEST_CASE("batch norm normalises by the batch's biased variance") {
  for (const Shape& shape : {Shape{4, 2}, Shape{2, 2, 1, 2}}) {
    const Result r = trained(shape, {.epsilon = 0.25});
    REQUIRE(r.y.shape() == shape);
    for (Index i = 0; i < 4; ++i) {
      CHECK(r.y.data<double>()[2 * i] ==
            Approx((2.0 * static_cast<double>(i) - 3) / std::sqrt(5.25) * 2 + 0.5).epsilon(1e-14));
      CHECK(r.y.data<double>()[2 * i + 1] == Approx((i % 2 == 0 ? -1 : 1) / std::sqrt(1.25) * 3 - 0.5).epsilon(1e-14));
    }
  }
}

TEST_CASE("moving statistics follow the batch as in Keras") {
  const Result r = trained({4, 2}, {.momentum = 0.9, .convention = MomentumConvention::keras});
  check_pair(r.mean, 0.9 * 10 + 0.1 * 3, 0.9 * 20 - 0.1 * 1);
  check_pair(r.variance, 0.9 * 2 + 0.1 * 5, 0.9 * 4 + 0.1 * 1);
}

TEST_CASE("moving statistics follow the batch as in PyTorch") {
  const Result r = trained({4, 2}, {.momentum = 0.1, .convention = MomentumConvention::pytorch});
  check_pair(r.mean, 0.9 * 10 + 0.1 * 3, 0.9 * 20 - 0.1 * 1);
  check_pair(r.variance, 0.9 * 2 + 0.1 * 20 / 3, 0.9 * 4 + 0.1 * 4 / 3);
}

TEST_CASE("inference normalises by the given statistics and does not change them") {
  const Tensor mean = pair(1, 2), variance = pair(4, 9),
               x = Tensor::from<double>({2, 2}, std::vector<double>{3, 5, 1, -4});
  const Tensor y = ops::batch_norm_inference(x, pair(2, 3), pair(0.5, -0.5), mean, variance, 0);
  const Tensor truth = Tensor::from<double>({2, 2}, std::vector<double>{2.5, 2.5, 0.5, -6.5});
  CHECK(error_in_epsilons(y, truth, Tensor::full({2, 2}, 8, DType::f64)) <= 1);
  CHECK(same_bits(mean, pair(1, 2)));
  CHECK(same_bits(variance, pair(4, 9)));
}

TEST_CASE("statistics in f32 survive a mean far from zero") {
  // The one-pass formula E[x²] − E[x]² would lose the variance of 1/3 beside a mean of 4096.
  const Tensor x = random_tensor({20000, 3}, 1, DType::f32, 4095, 4097);
  Tensor mean = Tensor::zeros({3}), variance = Tensor::zeros({3});
  const Tensor ones = Tensor::full({3}, 1);
  ops::batch_norm_training(x, ones, ones, mean, variance, {.momentum = 0});
  for (Index c = 0; c < 3; ++c) {
    CHECK(mean.data<float>()[c] == Approx(4096).margin(0.02));
    CHECK(variance.data<float>()[c] == Approx(1.0 / 3).margin(0.01));
  }
}
