#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <csignal>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

#include "io/views/scores_file.h"
#include "mpi/ranks.h"
#include "shell.h"
#include "views_on_disk.h"

using namespace svnet;
using namespace svnet::io;

namespace {

/// A dataset with features, and svnet-score run on it.
class Workplace {
 public:
  explicit Workplace(Index dimension = 8) { write_views(folder, 6, 3, 5, dimension); }

  static std::string command(const std::string& arguments) {
    return SVNET_SCORE " --features features.h5 --dataset data " + arguments;
  }
  Ran shell(const std::string& line) const { return run_shell(folder.path(), line); }
  Ran run(const std::string& arguments) const { return shell(command(arguments)); }
  Ran run_ranks(int ranks, const std::string& arguments) const { return shell(with_ranks(ranks, command(arguments))); }
  std::string contents(const std::string& name) const { return file_contents(folder.path() / name); }

  TemporaryFolder folder;
};

}  // namespace

TEST_CASE("svnet-score says how reliable the scores are") {
  const Workplace place;
  const Ran ran = place.run("--output s.h5 --target-error 0.005 --exclude category1");
  CHECK(ran.err.find("semantic scores") != std::string::npos);
  REQUIRE(ran.status == 0);
  CHECK_THAT(ran.out, Catch::Contains("s.h5: ") && Catch::Contains("standard error 0.00") &&
                          Catch::Contains("rank stability of the views of a pose"));
  const Scores scores = read_scores(place.folder.path() / "s.h5");
  CHECK(scores.problems % 16384 == 0);
  for (std::size_t v = 0; v < scores.paths.size(); ++v) {
    const bool excluded = scores.paths[v].starts_with("category1/");
    CHECK((scores.count[v] == 0) == excluded);
    CHECK(std::isnan(scores.standard_error[v]) == excluded);
    CHECK(std::isnan(scores.rank_stability[v]) == excluded);
    CHECK_FALSE(scores.standard_error[v] > 0.005);
  }
  CHECK_FALSE(std::filesystem::exists(place.folder.path() / "s.h5.snapshot"));
}

TEST_CASE("the ranges of the sampler are options") {
  const Workplace place;
  REQUIRE(place.run("--output s.h5 --problems 1000 --min-categories 2 --max-categories 3 --max-objects 2").status == 0);
  CHECK(read_scores(place.folder.path() / "s.h5").sampler ==
        "uniform; categories 2 to 3, objects 1 to 2, one pose, one view; singletons zero");
}

TEST_CASE("svnet-score writes the same bytes if it is killed at random moments and resumed", "[slow]") {
  const Workplace place;
  const std::string rule = " --problems 1500000 --seed 3";
  REQUIRE(place.run("--output whole.h5" + rule).status == 0);
  RandomStream random(91, Stream::shuffle);
  const std::string arguments = "--output killed.h5 --resume --snapshot-seconds 0" + rule;
  int killed = 0;
  for (int kill = 0; kill < 20; ++kill) {
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      if (::chdir(place.folder.path().c_str()) != 0) ::_exit(126);
      ::execl("/bin/sh", "sh", "-c", ("exec " + Workplace::command(arguments) + " >out 2>err").c_str(), nullptr);
      ::_exit(127);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(random.below(700)));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    killed += WIFSIGNALED(status);
  }
  CHECK(killed > 5);
  const Ran last = place.run(arguments);
  INFO(last.err);
  REQUIRE(last.status == 0);
  CHECK(place.contents("killed.h5") == place.contents("whole.h5"));
}

TEST_CASE("svnet-score resumes a snapshot only with the same options") {
  const Workplace place;
  const std::string rule = "--problems 400000 --seed 4";
  REQUIRE(place.run("--output whole.h5 " + rule).status == 0);
  const std::string limited = "timeout -s KILL 0.7 " +
                              Workplace::command("--output s.h5 --snapshot-seconds 0 --threads 1 --problems 100000000");
  place.shell(limited);
  REQUIRE(std::filesystem::exists(place.folder.path() / "s.h5.snapshot"));
  const Ran other = place.run("--output s.h5 --resume " + rule);
  CHECK(other.status == 1);
  CHECK(other.err ==
        "svnet-score: s.h5.snapshot: a snapshot of other scores (other features, options or seed); repeat "
        "the command that made it, or leave out --resume\n");
  place.folder.write("s.h5.snapshot", "damaged");
  CHECK_THAT(place.run("--output s.h5 --resume " + rule).err, Catch::StartsWith("svnet-score: s.h5.snapshot: "));
  REQUIRE(place.run("--output s.h5 " + rule).status == 0);  // without --resume
  CHECK(place.contents("s.h5") == place.contents("whole.h5"));
}

TEST_CASE("one, two and three processes write the same scores") {
  if (!can_run_ranks()) return;
  const Workplace place;
  for (const std::string rule : {"--problems 70001", "--min-samples 30000", "--problems 3000 --linkage kmeans"}) {
    INFO(rule);
    REQUIRE(place.run("--output alone.h5 " + rule).status == 0);
    for (const int ranks : {1, 2, 3}) {
      INFO(ranks << " processes");
      const Ran ran = place.run_ranks(ranks, "--threads 1 --output ranks.h5 " + rule);
      INFO(ran.err);
      REQUIRE(ran.status == 0);
      CHECK(place.contents("ranks.h5") == place.contents("alone.h5"));
      CHECK(ran.out.find("ranks.h5: ") == ran.out.rfind("ranks.h5: "));  // one process reports
      std::filesystem::remove(place.folder.path() / "ranks.h5");
    }
  }
}

TEST_CASE("an error of several processes ends all of them") {
  if (!can_run_ranks()) return;
  const Workplace place;
  const Ran ran = place.run_ranks(2, "--threads 1 --output s.h5 --problems 10 --exclude nothing");
  CHECK(ran.status != 0);
  const auto said = ran.err.find("svnet-score: --exclude");
  CHECK(said != std::string::npos);
  CHECK(said == ran.err.rfind("svnet-score: "));  // once
}
