#include "train/stage_times.h"

#include <catch2/catch.hpp>
#include <thread>

#include "base/error.h"
#include "io/files/whole_file.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::train;

namespace {

Run run_in(const std::filesystem::path& folder) {
  return Run{.config = {},
             .dataset = {},
             .folder = folder,
             .held_out = {},
             .messages = {},
             .communicator = SingleProcess::shared()};
}

void wait() { std::this_thread::sleep_for(std::chrono::milliseconds(20)); }

}  // namespace

TEST_CASE("the time of a stage is without the stages that it starts") {
  const TemporaryFolder folder;
  const Run run = run_in(folder.path());
  {
    StageTimer scores(run, "scores, round 1");
    {
      StageTimer features(run, "features");
      wait();
      features.made();
    }
    scores.made();
  }
  const auto times = read_stage_times(folder.path());
  REQUIRE(times.size() == 2);
  CHECK(times[0].stage == "features");
  CHECK(times[0].seconds >= 0.02);
  CHECK(times[1].stage == "scores round 1");
  CHECK(times[1].seconds < times[0].seconds);
}

TEST_CASE("a stage that is reused keeps the time that it took") {
  const TemporaryFolder folder;
  const Run run = run_in(folder.path());
  StageTimer(run, "scores").reused();  // made before there was a file of times
  CHECK(read_stage_times(folder.path()).empty());
  {
    StageTimer timer(run, "scores");
    wait();
    timer.made();
  }
  const double seconds = read_stage_times(folder.path())[0].seconds;
  StageTimer(run, "scores").reused();
  const auto times = read_stage_times(folder.path());
  REQUIRE(times.size() == 1);
  CHECK(times[0].seconds == seconds);
  CHECK(times[0].reused);
  StageTimer(run, "scores").made();
  CHECK_FALSE(read_stage_times(folder.path())[0].reused);
}

TEST_CASE("times of folds are added") {
  const TemporaryFolder folder;
  folder.write("timings.csv", "stage,seconds,reused\nfeatures,2,1\n");
  folder.write("fold-1/timings.csv", "stage,seconds,reused\nscores,3,1\nSV-net,1,0\n");
  folder.write("fold-2/timings.csv", "stage,seconds,reused\nscores,4.5,1\nSV-net,1,1\n");
  const auto times = read_stage_times(folder.path());
  REQUIRE(times.size() == 3);
  CHECK(times[1].stage == "scores");
  CHECK(times[1].seconds == 7.5);
  CHECK(times[1].reused);
  CHECK_FALSE(times[2].reused);
}

TEST_CASE("a damaged file of times is named") {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "timings.csv").string();
  folder.write("timings.csv", "stage,seconds,reused\nfeatures,2,1\nscores,x,0\n");
  CHECK_THROWS_WITH(read_stage_times(folder.path()), Catch::StartsWith(file + ": line 3: "));
  folder.write("timings.csv", "seconds\n");
  CHECK_THROWS_WITH(read_stage_times(folder.path()), Catch::StartsWith(file + ": line 1: "));
}
