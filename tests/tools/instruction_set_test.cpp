// Every instruction set that the machine has gives the same features, semantic scores and predictions, up to rounding.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/cpu.h"
#include "io/views/features_file.h"
#include "io/views/scores_file.h"
#include "nn/kernels/packed/bf16_tile.h"
#include "workplace.h"

using namespace svnet;
using namespace svnet::io;

namespace {

/// Relative to the largest value: float32 sums of a dozen layers, taken in another order.
constexpr double kTolerance = 1e-4;

/// The largest difference, relative to the largest value.
template <class T>
double difference(const std::vector<T>& a, const std::vector<T>& b) {
  REQUIRE(a.size() == b.size());
  double largest = 0, apart = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a[i]) && std::isnan(b[i])) continue;
    largest = std::max(largest, std::abs(static_cast<double>(a[i])));
    apart = std::max(apart, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
  }
  REQUIRE(largest > 0);
  return apart / largest;
}

/// Scores by pose, as svnet-predict --json prints them.
std::vector<double> predicted(const std::string& json) {
  const auto parsed = nlohmann::json::parse(json);
  std::vector<std::array<double, 3>> views;
  for (const auto& view : parsed.at("views"))
    views.push_back({view.at("theta_deg"), view.at("phi_deg"), view.at("score")});
  std::sort(views.begin(), views.end());
  std::vector<double> scores;
  for (const auto& view : views) scores.push_back(view[2]);
  return scores;
}

struct Results {
  std::vector<float> features;
  std::vector<double> individual, global, predictions;
};

Results results(const Workplace& place, const std::string& instruction_set) {
  const std::string set = "SVNET_MAX_ISA=" + instruction_set + " ";
  place.output_of(set +
                  "svnet-features --quiet --backbone tiny_xception --weights weights/tiny_xception.h5 --images data "
                  "--output its.h5");
  place.output_of(set + "svnet-score --quiet --dataset data --features its.h5 --problems 300 --output its-scores.h5");
  const Scores scores = read_scores(place / "its-scores.h5");
  return {read_features(place / "its.h5").values, scores.individual, scores.global,
          predicted(place.output_of(set + "svnet-predict model.safetensors --image top.png --json"))};
}

/// What svnet-features makes of the pictures with an environment ("NAME=value ") and options (" --name value").
Features features_of(const Workplace& place, const std::string& environment, const std::string& options) {
  place.output_of(environment +
                  "svnet-features --quiet --backbone tiny_xception --weights weights/tiny_xception.h5 --images data "
                  "--output its.h5" +
                  options);
  return read_features(place / "its.h5");
}

}  // namespace

TEST_CASE("features in bf16 are near those in f32, are marked as bf16 and have another fingerprint") {
  if (!kernels::machine_has_bf16()) {
    WARN("this processor has no AVX512-BF16: nothing is tested");
    return;
  }
  const Workplace place;
  const auto features = [&](const std::string& environment, const std::string& option) {
    return features_of(place, environment, option);
  };
  const Features plain = features("", ""), coarse = features("SVNET_PRECISION=f32 ", " --precision bf16");
  CHECK(difference(plain.values, coarse.values) <= 2e-2);
  CHECK(plain.values != coarse.values);
  CHECK(coarse.preprocessing == plain.preprocessing + ", products in bf16");
  CHECK(coarse.input_fingerprint != plain.input_fingerprint);
  CHECK(features("SVNET_PRECISION=bf16 ", "").values == coarse.values);
  CHECK(features("SVNET_PRECISION=bf16 ", " --precision f32").values == plain.values);
}

TEST_CASE(
    "features in int8 are near those in f32, are marked with their ranges and have the same bits with and without "
    "VNNI") {
  const Workplace place;
  const auto features = [&](const std::string& environment, const std::string& option) {
    return features_of(place, environment, option);
  };
  const Features plain = features("", ""), coarse = features("", " --precision int8");
  CHECK(difference(plain.values, coarse.values) <= 0.1);
  CHECK(plain.values != coarse.values);
  CHECK_THAT(coarse.preprocessing, Catch::StartsWith(plain.preprocessing + ", products in int8, ranges "));
  CHECK(coarse.input_fingerprint != plain.input_fingerprint);
  CHECK(features("SVNET_PRECISION=int8 ", " --threads 1").values == coarse.values);
  CHECK(features("SVNET_PRECISION=int8 ", " --threads 8").values == coarse.values);
  CHECK(features("SVNET_PRECISION=int8 ", " --precision f32").values == plain.values);
  // Other ranges are other features.
  const Features few = features("", " --precision int8 --calibration 2");
  CHECK(few.input_fingerprint != coarse.input_fingerprint);
  CHECK(few.values != coarse.values);
  for (const std::string& set : instruction_sets())
    if (set.starts_with("AVX")) {
      INFO(set);
      const Features capped = features("SVNET_MAX_ISA=" + set + " ", " --precision int8");
      CHECK(capped.values == coarse.values);
      CHECK(capped.input_fingerprint == coarse.input_fingerprint);
    }
}

TEST_CASE("int8 is refused where there are no ranges of activations") {
  const Workplace place;
  const auto refused = [&](const std::string& command) {
    const auto result = place.run("SVNET_PRECISION=int8 " + command);
    CHECK(result.status == 1);
    return result.err;
  };
  CHECK_THAT(refused("svnet-predict model.safetensors --image top.png"),
             Catch::Contains("[precision] int8 needs the ranges of activations"));
  CHECK_THAT(refused("svnet-pretrain --images data --backbone tiny_xception --output its.safetensors"),
             Catch::Contains("[SVNET_PRECISION] int8 is for trained backbones; choose f32 or bf16"));
}

TEST_CASE("SVNET_MAX_ISA: svnet-info prints the instruction set in use") {
  const Workplace place;
  for (const std::string& set : instruction_sets())
    CHECK_THAT(place.output_of("SVNET_MAX_ISA=" + set + " svnet-info"), Catch::Contains("\nkernels: " + set + " "));
  CHECK_THAT(place.output_of("svnet-info"), Catch::Contains("\nkernels: " + instruction_sets().front() + " "));
}

TEST_CASE("svnet-info names the kernels of OpenBLAS, which OPENBLAS_CORETYPE chooses and SVNET_MAX_ISA does not") {
  const Workplace place;
  const auto openblas_line = [&](const std::string& variables) {
    const std::string text = place.output_of("env -u OPENBLAS_CORETYPE " + variables + " svnet-info");
    const auto begin = text.find("matrix products of OpenBLAS: ");
    REQUIRE(begin != std::string::npos);
    return text.substr(begin, text.find('\n', begin) - begin);
  };
  CHECK_THAT(openblas_line("OPENBLAS_CORETYPE=Prescott"), Catch::Contains(": Prescott "));
  CHECK(openblas_line("SVNET_MAX_ISA=" + instruction_sets().back()) == openblas_line(""));
}

TEST_CASE("wrong words in the environment are errors") {
  const Workplace place;
  const auto error_of = [&](const std::string& variable) {
    return place.run(variable + " svnet-predict model.safetensors --image top.png").err;
  };
  CHECK(error_of("SVNET_PRECISION=half") == "svnet-predict: [SVNET_PRECISION] 'half' is none of f32, bf16, int8\n");
  CHECK(error_of("SVNET_CONVOLUTION=fast") ==
        "svnet-predict: [SVNET_CONVOLUTION] 'fast' is none of direct, winograd\n");
}

TEST_CASE("SVNET_MAX_ISA: all instruction sets agree to 1e-4") {
  const Workplace place;
  const std::vector<std::string> sets = instruction_sets();
  const Results best = results(place, sets.front());
  bool differ = false;
  for (const std::string& set : sets) {
    INFO(set);
    const Results capped = results(place, set);
    CHECK(difference(best.features, capped.features) <= kTolerance);
    CHECK(difference(best.individual, capped.individual) <= kTolerance);
    CHECK(difference(best.global, capped.global) <= kTolerance);
    CHECK(difference(best.predictions, capped.predictions) <= kTolerance);
    differ |= best.features != capped.features;
  }
  if (sets.size() > 1) CHECK(differ);  // otherwise the cap had no effect
}
