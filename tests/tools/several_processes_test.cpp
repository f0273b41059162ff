#include <catch2/catch.hpp>

#include "base/cpu.h"
#include "mpi/ranks.h"
#include "workplace.h"

using namespace svnet;

namespace {

constexpr const char* kTrain = "svnet-train config.yaml --threads 1 --set sv_net.width=300";

/// The number of occurrences of `part` in `text`.
int occurrences(const std::string& text, const std::string& part) {
  int count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

bool has_more_than_sse4() {
  const bool more = instruction_sets().front() != "SSE4" && instruction_sets().size() > 1;
  if (!more) WARN("skipped: there is no better instruction set than the one to keep to");
  return more;
}

/// Runs the command as `ranks` processes (0: without mpirun) and requires exit 0.
std::string progress_of(const Workplace& place, int ranks, const std::string& command) {
  const Ran ran = place.run(ranks == 0 ? command : with_ranks(ranks, command));
  INFO(command << "\n" << ran.err);
  REQUIRE(ran.status == 0);
  return ran.err;
}

}  // namespace

TEST_CASE("one, two and three processes extract the same features") {
  if (!can_run_ranks()) return;
  const Workplace place;  // 32 images: two batches, so that one process has none
  for (const int ranks : {1, 2, 3}) {
    INFO(ranks << " processes");
    progress_of(place, ranks,
                "svnet-features --threads 1 --backbone tiny_xception --weights weights/tiny_xception.h5 --images data "
                "--output ranks.h5");
    CHECK(file_contents(place / "ranks.h5") == file_contents(place / "features.h5"));
    std::filesystem::remove(place / "ranks.h5");
  }
}

TEST_CASE("one, two and three processes train the same model") {
  if (!can_run_ranks()) return;
  const Workplace place;
  const std::string options = GENERATE("", " --set training.validation_categories=1 --set training.optimizer=sgd",
                                       " --set training.fine_tune=last_block --set training.epochs=1");
  INFO(options);
  for (const int ranks : {0, 1, 2, 3}) {
    INFO(ranks << " processes");
    const std::string folder = "run" + std::to_string(ranks);
    const std::string said = progress_of(place, ranks, kTrain + options + " --output " + folder);
    CHECK(occurrences(said, "epoch 1/") == 1);
    for (const char* file : {"features-tiny_xception.h5", "scores.h5", "checkpoint-last.safetensors",
                             "checkpoint-best.safetensors", "metrics.csv", "model.safetensors"}) {
      if (!std::filesystem::exists(place / "run0" / file)) continue;  // fine-tuning writes fewer files
      INFO(file);
      CHECK(file_contents(place / folder / file) == file_contents(place / "run0" / file));
    }
    CHECK(std::filesystem::exists(place / folder / "model.safetensors"));
  }
}

TEST_CASE("one and two processes make the same on-policy scores of two backbones") {
  if (!can_run_ranks()) return;
  const Workplace place;
  const std::string options =
      " --set scores.rounds=1 --set scores.backbones=[tiny_xception,mobilenet_v2] --set weights.folder= "
      "--set training.epochs=1";
  for (const int ranks : {0, 2}) {
    INFO(ranks << " processes");
    const std::string folder = "rounds" + std::to_string(ranks);
    progress_of(place, ranks, kTrain + options + " --output " + folder);
    for (const char* file : {"scores.h5", "scores-round-1.h5", "scores-mobilenet_v2-round-1.h5",
                             "round-1/model.safetensors", "model.safetensors"}) {
      INFO(file);
      CHECK(file_contents(place / folder / file) == file_contents(place / "rounds0" / file));
    }
  }
  CHECK(occurrences(progress_of(place, 2, kTrain + options + " --output rounds0"), "reused") == 5);
}

TEST_CASE("several processes resume a run folder") {
  if (!can_run_ranks()) return;
  const Workplace place;
  progress_of(place, 0, std::string(kTrain) + " --output whole");
  progress_of(place, 2, std::string(kTrain) + " --set training.epochs=2 --output run");
  CHECK(occurrences(progress_of(place, 2, std::string(kTrain) + " --output run"), "reused") == 3);
  std::filesystem::remove(place / "run/model.safetensors");
  CHECK(occurrences(progress_of(place, 3, std::string(kTrain) + " --output run"), "goes on after epoch 2") == 1);
  CHECK(file_contents(place / "run/model.safetensors") == file_contents(place / "whole/model.safetensors"));
}

TEST_CASE("an error of all processes is printed once") {
  if (!can_run_ranks()) return;
  const Workplace place;
  const Ran ran = place.run(with_ranks(3, std::string(kTrain) + " --set dataset.root=nowhere"));
  CHECK(ran.status != 0);
  CHECK(occurrences(ran.err, "svnet-train: ") == 1);
  CHECK_THAT(ran.err, Catch::Contains("nowhere: no such folder"));
  const Ran usage = place.run(with_ranks(2, "svnet-train"));
  CHECK(usage.status != 0);
  CHECK_THAT(usage.err, Catch::Contains("svnet-train: CONFIG is required"));
}

TEST_CASE("an error of one process is printed by it and ends all") {
  if (!can_run_ranks()) return;
  const Workplace place;
  const std::string train = std::string(kTrain) + " --set training.epochs=1000000 --output run";
  const Ran ran = place.run(with_ranks(1, train + " --quiet : -n 1 " + train + " --set dataset.root=nowhere"));
  CHECK(ran.status != 0);
  CHECK(occurrences(ran.err, "svnet-train: ") == 1);
  CHECK_THAT(ran.err, Catch::Contains("nowhere: no such folder"));
}

TEST_CASE("processes with different parameters are an error") {
  if (!can_run_ranks() || !has_more_than_sse4()) return;
  const Workplace place;
  const std::string train = std::string(kTrain) + " --quiet --output run";
  const Ran ran = place.run(with_ranks(1, train + " : -n 1 env SVNET_MAX_ISA=SSE4 " + train));
  CHECK(ran.status != 0);
  CHECK_THAT(ran.err, Catch::Contains("process 1 has other parameters than process 0 after epoch 1; processes must run "
                                      "on processors of one kind"));
}

TEST_CASE("processes use the instruction set of SVNET_MAX_ISA") {
  if (!can_run_ranks() || !has_more_than_sse4()) return;
  const Workplace place;
  progress_of(place, 2, std::string(kTrain) + " --output run");
  const Ran ran = place.run("SVNET_MAX_ISA=SSE4 " + with_ranks(2, std::string(kTrain) + " --output capped"));
  INFO(ran.err);
  REQUIRE(ran.status == 0);
  CHECK(file_contents(place / "capped/model.safetensors") != file_contents(place / "run/model.safetensors"));
}

TEST_CASE("a dry run of several processes is one") {
  if (!can_run_ranks()) return;
  const Workplace place;
  CHECK(place.output_of(with_ranks(2, std::string(kTrain) + " --quiet --dry-run")) == "dry run: every stage works\n");
}
