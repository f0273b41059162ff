#include "info/plan_text.h"

#include <catch2/catch.hpp>
#include <sstream>

#include "models/backbone.h"
#include "small_model.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
using namespace svnet::models;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The last four words: MFLOP, MB, ms, GFLOP/s; a "-" is 0.
std::array<double, 4> numbers_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  REQUIRE(words.size() >= 5);
  std::array<double, 4> numbers{};
  for (std::size_t i = 0; i < 4; ++i)
    if (const std::string& word = words[words.size() - 4 + i]; word != "-") numbers[i] = std::stod(word);
  return numbers;
}

}  // namespace

TEST_CASE("a plan lists every step in aligned columns, and their sums") {
  const auto lines = lines_of(backbone_plan("tiny_xception", "", 3, {}));
  const Inference network = [] {
    const Backbone backbone = random_backbone("tiny_xception", "", 1);
    return Inference(backbone.graph(), backbone.parameters(), backbone.graph().output());
  }();
  const auto steps = network.report(3);
  REQUIRE(lines.size() == steps.size() + 4);
  CHECK(lines[0] == "tiny_xception to avg_pool");
  CHECK_THAT(lines[1], Catch::StartsWith("layer") && Catch::EndsWith("GFLOP/s"));
  double flops = 0, bytes = 0, sum_ms = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::string& line = lines[i + 2];
    INFO(line);
    CHECK(line.size() == lines[1].size());
    CHECK_THAT(line, Catch::StartsWith(steps[i].layer + " ") && Catch::Contains(" " + steps[i].kernel + " "));
    const auto numbers = numbers_of(line);
    CHECK(numbers[0] == Approx(steps[i].flops / 1e6).margin(0.006));
    CHECK(numbers[1] == Approx(steps[i].bytes / 1e6).margin(0.006));
    flops += steps[i].flops, bytes += steps[i].bytes, sum_ms += numbers[2];
  }
  const std::string& total = lines[steps.size() + 2];
  CHECK(total.size() == lines[1].size());
  CHECK_THAT(total, Catch::StartsWith("total "));
  CHECK(numbers_of(total)[0] == Approx(flops / 1e6).margin(0.006));
  CHECK(numbers_of(total)[1] == Approx(bytes / 1e6).margin(0.006));
  CHECK(numbers_of(total)[2] == Approx(sum_ms).margin(0.001 * static_cast<double>(steps.size())));
  CHECK_THAT(lines.back(), Catch::StartsWith("arena ") && Catch::Contains(" MB for a batch of 3 on "));
}

TEST_CASE("the plan of a model has its backbone and its head") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "model.safetensors";
  write_model(file, small_model());
  const auto lines = lines_of(model_plan(file, 1, {}));
  CHECK(lines[0] == "tiny_xception to avg_pool");
  const auto head = std::find(lines.begin(), lines.end(), "SV-net");
  REQUIRE(head != lines.end());
  CHECK(std::find_if(head, lines.end(), [](const auto& line) { return line.starts_with("score "); }) != lines.end());
  CHECK_THROWS_WITH(model_plan(folder.path() / "none.safetensors", 1, {}), Catch::Contains("none.safetensors: "));
}

TEST_CASE("a plan ends at the given layer, also if it is part of the top") {
  CHECK_THAT(lines_of(backbone_plan("mobilenet_v2", "block_1_expand_relu", 1, {}))[0],
             Catch::Contains("to block_1_expand_relu"));
  CHECK_THAT(backbone_plan("mobilenet_v2", "predictions", 1, {}), Catch::Contains("\npredictions "));
  CHECK_THROWS_WITH(backbone_plan("vgg20", "", 1, {}), Catch::Contains("there is no backbone 'vgg20', did you mean"));
}
