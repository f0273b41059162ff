#include <catch2/catch.hpp>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "frame/top_view.h"
#include "loaded_model.h"

using namespace svnet;

namespace {

/// Collects lines while it exists.
struct Lines {
  Lines() { REQUIRE(svnet_set_log(add, this) == SVNET_OK); }
  ~Lines() { svnet_set_log(nullptr, nullptr); }
  Lines(const Lines&) = delete;
  Lines& operator=(const Lines&) = delete;

  static void add(svnet_log_level level, const char* line, void* user_data) {
    auto* self = static_cast<Lines*>(user_data);
    const std::lock_guard lock(self->mutex);
    self->levels.push_back(level);
    self->text.emplace_back(line);
  }

  std::mutex mutex;
  std::vector<svnet_log_level> levels;
  std::vector<std::string> text;
};

}  // namespace

TEST_CASE("the log says how a model was loaded and how many threads there are") {
  Lines lines;
  const Loaded loaded;
  REQUIRE(lines.text.size() == 2);
  CHECK_THAT(lines.text[0], Catch::Contains("model.safetensors: loaded in ") && Catch::Contains(" ms; threads ") &&
                                Catch::Contains("instruction set "));
  CHECK_THAT(lines.text[1], Catch::Contains("frame camera, ") && Catch::Contains(" features, f32; backbone: ") &&
                                Catch::Contains("packed gemm"));
  CHECK(svnet_set_threads(2) == SVNET_OK);
  REQUIRE(lines.text.size() == 3);
  CHECK(lines.text[2] == "threads 2");
  CHECK(lines.levels == std::vector<svnet_log_level>(3, SVNET_LOG_INFO));
}

TEST_CASE("the log warns of a shape that the model was not trained on") {
  Model model = small_axis_model();
  model.seen = {.mean = {5, 5, 5}, .deviation = {0.1, 0.1, 0.1}, .limit = 1};
  const Loaded loaded(model);
  const Image image = frame::picture_of(frame::wedge(1.3, 0.5, 70));
  Lines lines;
  loaded.embed(image.rgb, 224, 224, 672, SVNET_RGB8);
  REQUIRE(lines.text.size() == 1);
  CHECK(lines.levels[0] == SVNET_LOG_WARNING);
  CHECK_THAT(lines.text[0], Catch::StartsWith("the object's shape is unlike those that the model was trained on: "));
}

TEST_CASE("without a callback nothing is logged, and a callback cannot replace itself") {
  { const Lines lines; }
  CHECK(svnet_set_threads(2) == SVNET_OK);
  struct Seen {
    svnet_status status = SVNET_OK;
    std::string error;
    int calls = 0;
  } seen;
  const auto replace = [](svnet_log_level, const char*, void* user_data) {
    auto* mine = static_cast<Seen*>(user_data);
    ++mine->calls;
    mine->status = svnet_set_log(nullptr, nullptr);
    mine->error = svnet_last_error();
  };
  REQUIRE(svnet_set_log(replace, &seen) == SVNET_OK);
  CHECK(svnet_set_threads(2) == SVNET_OK);
  CHECK(svnet_set_log(nullptr, nullptr) == SVNET_OK);
  CHECK(seen.calls == 1);
  CHECK(seen.status == SVNET_INVALID_ARGUMENT);
  CHECK(seen.error == "[svnet_set_log] was called from within the callback, which it would wait for");
}

TEST_CASE("the callback changes while other threads log") {
  const Loaded loaded;
  std::vector<std::thread> threads;
  for (int i = 0; i < 2; ++i)
    threads.emplace_back([] {
      for (int call = 0; call < 50; ++call) svnet_set_threads(2);
    });
  for (int change = 0; change < 50; ++change) const Lines lines;  // gone after each change
  for (auto& thread : threads) thread.join();
}
