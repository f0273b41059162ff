#include "train/ridge.h"

#include <catch2/catch.hpp>
#include <limits>

#include "base/random.h"

using namespace svnet;
using namespace svnet::train;

namespace {

double uniform(RandomStream& random) { return random.bits32() * 0x1p-31 - 1; }

/// y = 2 x0 - x1 + an offset of the pose + noise; x2 is noise alone. 8 categories of 3 poses of 10 views.
PoseExamples examples(double noise) {
  PoseExamples e{.inputs = 3};
  RandomStream random(5, Stream::weights);
  for (std::int32_t pose = 0; pose < 24; ++pose) {
    const double offset = 10 * uniform(random);
    for (int view = 0; view < 10; ++view) {
      const double x[] = {uniform(random) + offset, uniform(random), uniform(random)};
      e.x.insert(e.x.end(), x, x + 3);
      e.y.push_back(2 * (x[0] - offset) - x[1] + offset * 3 + noise * uniform(random));
      e.weight.push_back(1);
      e.pose.push_back(pose);
      e.category.push_back(pose / 3);
    }
  }
  return e;
}

}  // namespace

TEST_CASE("ridge regression finds the slopes within poses, whatever the offsets of poses") {
  const RidgeFit fit = fit_ridge(examples(0), {.small_penalty = {true, true, false}});
  REQUIRE(fit.weights.size() == 3);
  CHECK(fit.weights[0] == Approx(2).margin(0.04));
  CHECK(fit.weights[1] == Approx(-1).margin(0.02));
  CHECK(fit.weights[2] == Approx(0).margin(0.01));
  CHECK(fit.error < 1e-3);
}

TEST_CASE("the mean prediction of the examples is 0") {
  const PoseExamples e = examples(0.5);
  const RidgeFit fit = fit_ridge(e, {.small_penalty = {true, false, false}});
  double sum = 0;
  for (std::size_t i = 0; i < e.y.size(); ++i) {
    sum += fit.bias;
    for (std::size_t k = 0; k < 3; ++k) sum += fit.weights[k] * e.x[i * 3 + k];
  }
  CHECK(sum / static_cast<double>(e.y.size()) == Approx(0).margin(1e-9));
}

TEST_CASE("inputs of noise alone get a large penalty") {
  PoseExamples e = examples(0);
  RandomStream random(9, Stream::weights);
  for (double& y : e.y) y = uniform(random);
  const RidgeFit fit = fit_ridge(e, {.small_penalty = {false, false, false}});
  CHECK(fit.penalty >= 10);
  CHECK(fit.error > 0.9);
}

TEST_CASE("an example of weight near 0 does not move the fit") {
  PoseExamples e = examples(0);
  e.y[7] += 100;
  e.weight[7] = 1e-12;
  const RidgeFit fit = fit_ridge(e, {.small_penalty = {true, true, false}});
  CHECK(fit.weights[0] == Approx(2).margin(0.04));
}

TEST_CASE("a fit needs two categories and finite values") {
  PoseExamples e = examples(0);
  e.category.assign(e.category.size(), 0);
  CHECK_THROWS_WITH(fit_ridge(e, {.small_penalty = {false, false, false}}), Catch::Contains("at least 2 categories"));
  e = examples(0);
  e.y[3] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(fit_ridge(e, {.small_penalty = {false, false, false}}), Catch::Contains("not a finite number"));
}
