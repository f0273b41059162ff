// Run folders that two processes want, that were moved, and systems where little can be written.
#include <catch2/catch.hpp>

#include "workplace.h"

using namespace svnet;
using Catch::Contains;

TEST_CASE("a second svnet-train in a run folder is refused, until the first has ended, if only by a kill") {
  const Workplace place;
  // The first is stopped once it holds the folder, and lives until it is killed.
  const Ran ran = place.run(
      "svnet-train config.yaml --output run --threads 1 --set training.epochs=100000 >first 2>&1 & first=$!; "
      "for i in $(seq 600); do grep -q 'epoch 1/' run/log.txt 2>/dev/null && break; sleep 0.1; done; "
      "svnet-train config.yaml --output run --threads 1 --quiet; echo \"second $?\"; "
      "svnet-train config.yaml --output other --threads 1 --quiet >/dev/null; echo \"other $?\"; "
      "kill -KILL $first; wait $first; "
      "svnet-train config.yaml --output run --threads 1 --quiet >/dev/null; echo \"after $?\"");
  INFO(ran.out << ran.err);
  CHECK_THAT(ran.out, Contains("second 1") && Contains("other 0") && Contains("after 0"));
  CHECK_THAT(ran.err, Contains("svnet-train: run: another svnet-train is at work in this run folder"));
}

// The lock is the kernel's, and knows no names of hosts: two containers that share a folder keep each other away as two
// processes do.
TEST_CASE("a second host in a run folder is refused") {
  const Workplace place;
  if (place.run("unshare --uts true").status != 0) {
    WARN("this user cannot give a process another host name: nothing is tested");
    return;
  }
  const Ran ran = place.run(
      "svnet-train config.yaml --output run --threads 1 --set training.epochs=100000 >first 2>&1 & first=$!; "
      "for i in $(seq 600); do grep -q 'epoch 1/' run/log.txt 2>/dev/null && break; sleep 0.1; done; "
      "unshare --uts sh -c 'hostname elsewhere && hostname && exec svnet-train config.yaml --output run --threads 1 "
      "--quiet'; "
      "echo \"second $?\"; kill -KILL $first; wait $first");
  INFO(ran.out << ran.err);
  CHECK_THAT(ran.out, Contains("elsewhere") && Contains("second 1"));
  CHECK_THAT(ran.err, Contains("svnet-train: run: another svnet-train is at work in this run folder"));
}

TEST_CASE("a training that is told to end saves its state, and the next one goes on from it") {
  const Workplace place;
  const Ran ran = place.run(
      "train='svnet-train config.yaml --output run --threads 1 --set training.epochs=100000'; "
      "wait_for() { for i in $(seq 600); do grep -q \"$1\" run/log.txt 2>/dev/null && break; sleep 0.1; done; }; "
      "$train >first 2>&1 & process=$!; wait_for 'epoch 1/'; kill -TERM $process; wait $process; echo \"first $?\"; "
      "$train >second 2>&1 & process=$!; wait_for 'goes on after epoch'; kill -TERM $process; wait $process; "
      "echo \"second $?\"; cat second; ls run");
  INFO(ran.out << ran.err);
  CHECK_THAT(ran.out, Contains("first 130") && Contains("second 130") && Contains("training: goes on after epoch ") &&
                          Contains("svnet-train: interrupted") && Contains("checkpoint-last.safetensors") &&
                          !Contains("model.safetensors"));
}

TEST_CASE("a run folder works after it was moved with its data, or without them by --set") {
  const Workplace place;
  place.output_of(
      "mkdir project && cp -r data weights config.yaml project && cd project && "
      "svnet-train config.yaml --output runs/a --threads 1 --quiet && cd .. && mv project moved");
  CHECK_THAT(file_contents(place / "moved/runs/a/config.yaml"), Contains("root: ../../data"));
  CHECK_THAT(place.output_of("svnet-eval moved/runs/a --threads 1 --quiet"), Contains("Training categories"));
  place.output_of("mv moved/data photos; mv moved/runs/a run");
  const Ran ran = place.run("svnet-eval run --threads 1 --quiet");
  CHECK(ran.status == 1);
  CHECK_THAT(ran.err, Contains("no such folder; if the data set was moved, say where it is by --set dataset.root=DIR"));
  CHECK_THAT(
      place.output_of("svnet-eval run --threads 1 --quiet --set dataset.root=photos --set weights.folder=weights"),
      Contains("Training categories"));
}

TEST_CASE("svnet-eval writes its JSON alone to standard output, and to pipes") {
  const Workplace place;
  place.output_of("svnet-train config.yaml --output run --threads 1 --quiet");
  const std::string json = place.output_of("svnet-eval run --threads 1 --quiet --json /dev/stdout | cat");
  CHECK(json == file_contents(place / "run/evaluation.json"));
  place.output_of("svnet-eval run --threads 1 --quiet --json /dev/stdout >tables.json");
  CHECK(json == file_contents(place / "tables.json"));
  place.output_of("mkfifo pipe; cat pipe >piped.json & svnet-eval run --threads 1 --quiet --json pipe >text; wait");
  CHECK(json == file_contents(place / "piped.json"));
  CHECK_THAT(file_contents(place / "text"), Contains("Training categories"));
}

TEST_CASE("a dry run says which folder it cannot write to, and why") {
  const Workplace place;
  const std::string dry = "svnet-train config.yaml --dry-run --quiet --threads 1";
  const std::string no_folder = "is no folder for temporary files; set TMPDIR to one";
  for (const auto& [folder, problem] :
       {std::pair<std::string, std::string>{"/proc",
                                            "no temporary folder can be made in it: No such file or directory; set "
                                            "TMPDIR to a folder that can be written"},
        {"config.yaml", no_folder},
        {"none", no_folder}}) {
    const Ran ran = place.run("TMPDIR=" + folder + " " + dry);
    INFO(ran.err);
    CHECK(ran.status == 1);
    CHECK_THAT(ran.err, Contains(folder + ": " + problem));
  }
  // TMPDIR is used: the folder's time of change says so.
  place.output_of("mkdir scratch && touch -d 2001-01-01 scratch && TMPDIR=scratch " + dry +
                  " >/dev/null && test scratch -nt config.yaml && test -z \"$(ls -A scratch)\"");
}

TEST_CASE("processes of another MPI's launcher are refused, since each would do the whole work") {
  const Workplace place;
  for (const char* variables : {"PMI_SIZE=2 PMI_RANK=0", "PMI_SIZE=2", "MV2_COMM_WORLD_SIZE=2"}) {
    const Ran ran = place.run(std::string(variables) + " svnet-train config.yaml --output run --threads 1 --quiet");
    INFO(variables << "\n" << ran.err);
    CHECK(ran.status == 1);
    CHECK_THAT(ran.err, Contains("svnet-train: its launcher says that it started 2 processes") ||
                            Contains("svnet-train: started by mpirun or srun, but built without MPI"));
    CHECK_FALSE(std::filesystem::exists(place / "run"));
  }
}
