#include "train/pretraining.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/parallel.h"
#include "io/views/dataset_folder.h"
#include "small_dataset.h"

using namespace svnet;
using namespace svnet::io;
using namespace svnet::models;
using namespace svnet::train;

namespace {

PretrainingOptions small_options() {
  return {.exclude = {"ring"}, .epochs = 2, .batch_size = 8, .learning_rate = 2e-3, .seed = 4};
}

std::vector<float> numbers_of(const Parameters& parameters) {
  std::vector<float> numbers;
  for (const auto& [name, tensor] : parameters.items())
    numbers.insert(numbers.end(), tensor.values<float>().begin(), tensor.values<float>().end());
  return numbers;
}

}  // namespace

TEST_CASE("pretraining learns, and gives the same bits for any number of threads") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path());
  const ViewDataset dataset = read_view_dataset(temporary.path());
  const int threads_before = Parallel::shared().threads();
  std::vector<float> expected;
  for (const int threads : {1, 2, 5}) {
    Parallel::shared().resize(threads);
    std::vector<std::string> lines;
    const Messages messages{.line = [&](std::string_view line) { lines.emplace_back(line); }, .progress = {}};
    const Pretrained result = pretrain(dataset, small_options(), messages);
    CHECK(result.categories == std::vector<std::string>{"ball", "cone", "cube"});
    CHECK(result.training_images == 12);
    CHECK(result.validation_images == 12);
    CHECK(result.validation_accuracy >= 0);
    CHECK(result.validation_accuracy <= 1);
    REQUIRE(lines.size() == 2);
    CHECK_THAT(lines[1], Catch::StartsWith("epoch 2/2: loss ") && Catch::Contains(", of unseen objects "));
    const std::vector<float> numbers = numbers_of(result.backbone.parameters());
    if (expected.empty()) expected = numbers;
    CHECK(numbers == expected);
    CHECK(numbers != numbers_of(random_backbone("tiny_xception", "", 4).parameters()));
  }
  Parallel::shared().resize(threads_before);
}

TEST_CASE("a pretrained backbone distinguishes new objects", "[slow]") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path());
  PretrainingOptions options = small_options();
  options.exclude.clear();
  options.epochs = 40;
  options.augmentation = {.zoom = 0, .shift = 0, .turn_deg = 0, .brightness = 0, .contrast = 0, .colour = 0};
  const Pretrained result = pretrain(read_view_dataset(temporary.path()), options, {});
  CHECK(result.validation_accuracy >= 0.5);  // chance is 0.25, and half of the views are hardly informative
  options.validation_objects = 0;
  options.epochs = 1;
  const Pretrained whole = pretrain(read_view_dataset(temporary.path()), options, {});
  CHECK(whole.training_images == 32);
  CHECK(whole.validation_images == 0);
  CHECK(std::isnan(whole.validation_accuracy));
}

TEST_CASE("pretraining says what is wrong with its data") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path());
  const std::string root = temporary.path().string();
  const auto attempt = [&](const PretrainingOptions& options) {
    pretrain(read_view_dataset(temporary.path()), options, {});
  };
  PretrainingOptions options = small_options();
  options.validation_objects = 2;
  CHECK_THROWS_WITH(attempt(options), root +
                                          ": category 'ball' has 2 objects, and --validation-objects 2 leaves none of "
                                          "them to train on");
  options = small_options();
  options.exclude = {"ball", "cone", "cube"};
  CHECK_THROWS_WITH(attempt(options),
                    root + ": 1 categories to tell apart besides the excluded ones, at least 2 are needed");
  options.exclude = {"ball", "cone", "cube", "ring"};
  CHECK_THROWS_WITH(attempt(options),
                    root + ": 0 categories to tell apart besides the excluded ones, at least 2 are needed");
  options.exclude = {"rong"};
  CHECK_THROWS_WITH(attempt(options), "--exclude: the dataset has no category 'rong', did you mean 'ring'?");
  options = small_options();
  options.backbone = "tiny_exception";
  CHECK_THROWS_WITH(attempt(options), Catch::Contains("did you mean 'tiny_xception'?"));
  options = small_options();
  options.learning_rate = 1e30;
  options.epochs = 20;
  CHECK_THROWS_WITH(attempt(options), Catch::StartsWith("[pretraining] the loss is not finite at step ") &&
                                          Catch::EndsWith("; a smaller learning rate may help"));
  // In the last step, after which no loss is computed.
  options.batch_size = 4096;
  options.epochs = 1;
  options.learning_rate = 1e39;
  CHECK_THROWS_WITH(attempt(options),
                    Catch::StartsWith("[pretraining] ") &&
                        Catch::EndsWith(" is not finite after epoch 1; a smaller learning rate may help"));
  temporary.write("cone/1/1/45_0.png", "no image");
  CHECK_THROWS_WITH(attempt(small_options()),
                    root + "/cone/1/1/45_0.png: is not a PNG, JPEG or WebP image, whatever its name says");
}
