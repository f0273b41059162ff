#include "semantics/on_policy_weights.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/random.h"

using namespace svnet;
using namespace svnet::semantics;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Weights of the views of a single pose.
ViewWeights weights_of(const std::vector<double>& prediction, const OnPolicyOptions& options = {}) {
  return on_policy_weights(prediction, std::vector<std::int32_t>(prediction.size(), 0), options);
}

std::vector<double> random_predictions(Index views, std::uint64_t seed) {
  RandomStream random(seed, Stream::shuffle);
  std::vector<double> prediction;
  for (Index v = 0; v < views; ++v) prediction.push_back(random.normal());
  return prediction;
}

/// exp(entropy) of what is left of the weights without their uniform share.
double effective_views(const ViewWeights& weights, double uniform_share) {
  double entropy = 0;
  for (const double weight : weights) {
    const double p = (weight - uniform_share / static_cast<double>(weights.size())) / (1 - uniform_share);
    if (p > 1e-12) entropy -= p * std::log(p);
  }
  return std::exp(entropy);
}

}  // namespace

TEST_CASE("the softmax of each pose has the effective number of views that is asked for") {
  for (const Index views : {3, 21, 41})
    for (const double share : {0.4, 0.6, 0.9}) {
      const OnPolicyOptions options{.effective_share = share, .uniform_share = 0.25};
      const auto weights = weights_of(random_predictions(views, 31), options);
      INFO(views << " views, share " << share);
      CHECK(std::accumulate(weights.begin(), weights.end(), 0.0) == Approx(1).epsilon(1e-12));
      CHECK(effective_views(weights, 0.25) == Approx(share * static_cast<double>(views)).epsilon(1e-6));
    }
  CHECK(effective_views(weights_of(random_predictions(21, 32)), 0.25) == Approx(4.2).epsilon(1e-6));
}

TEST_CASE("weights grow with predictions, and neither their shift nor their scale matters") {
  const auto prediction = random_predictions(21, 33);
  const auto weights = weights_of(prediction);
  for (std::size_t i = 0; i < weights.size(); ++i)
    for (std::size_t j = 0; j < weights.size(); ++j)
      if (prediction[i] > prediction[j]) CHECK(weights[i] >= weights[j]);
  std::vector<double> moved;
  for (const double p : prediction) moved.push_back(1e-3 * p + 7);
  const auto of_moved = weights_of(moved);
  for (std::size_t i = 0; i < weights.size(); ++i) CHECK(of_moved[i] == Approx(weights[i]).epsilon(1e-9));
}

TEST_CASE("each pose has weights of its own") {
  const std::vector<double> prediction{1, 5, 2, 6, 3, 7};
  const auto weights = on_policy_weights(prediction, std::vector<std::int32_t>{0, 2, 0, 2, 0, 2});
  const auto first = weights_of({1, 2, 3}), second = weights_of({5, 6, 7});
  CHECK(weights == ViewWeights{first[0], second[0], first[1], second[1], first[2], second[2]});
}

TEST_CASE("equal predictions give uniform weights") {
  for (const double weight : weights_of({0.4, 0.4, 0.4, 0.4, 0.4})) CHECK(weight == Approx(0.2).epsilon(1e-12));
  CHECK(weights_of({0.3}) == ViewWeights{1});
}

TEST_CASE("few views: those with the highest prediction share what is not uniform") {
  const auto weights = weights_of({0.1, 0.9, 0.9, 0.2});
  CHECK(weights[0] == Approx(0.25 / 4).epsilon(1e-9));
  CHECK(weights[1] == Approx(0.25 / 4 + 0.75 / 2).epsilon(1e-9));
  CHECK(weights[2] == weights[1]);
  CHECK(weights[3] == weights[0]);
}

TEST_CASE("a view without a prediction has its uniform share") {
  const auto weights = weights_of({kNaN, 0.5, 0.5, std::numeric_limits<double>::infinity()});
  CHECK(weights[0] == 0.25 / 4);
  CHECK(weights[3] == 0.25 / 4);
  CHECK(weights[1] == Approx(0.25 / 4 + 0.75 / 2).epsilon(1e-12));
  CHECK(weights_of({kNaN, kNaN}) == ViewWeights{0.5, 0.5});
}

TEST_CASE("on-policy weights refuse what they cannot be made of") {
  CHECK_THROWS_WITH(on_policy_weights(std::vector<double>(3), std::vector<std::int32_t>(2)),
                    "[on-policy] 3 predictions of 2 views");
  CHECK_THROWS_WITH(on_policy_weights(std::vector<double>(1), std::vector<std::int32_t>{-1}),
                    "[on-policy] view 0 has pose -1; poses are numbered from 0");
  CHECK_THROWS_WITH(weights_of({1, 2}, {.effective_share = 0}),
                    "[on-policy] effective share 0, uniform share 0.25; both must be above 0 and at most 1");
}
