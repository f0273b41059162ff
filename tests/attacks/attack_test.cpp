// Every file of the corpus is refused with one clear line and status 1, in bounded memory and time.
#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "attacks.h"
#include "temporary_folder.h"

using namespace svnet::attacks;
namespace fs = std::filesystem;

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

struct Outcome {
  int status = 0;  // minus the signal if one ended it
  std::string err;
  std::uint64_t peak_bytes = 0;  // of the largest process
  double seconds = 0;
};

Outcome run(std::vector<std::string> words) {
  const TemporaryFolder output;
  const std::string err = output.path() / "err";
  const auto begin = std::chrono::steady_clock::now();
  const pid_t process = ::fork();
  if (process == 0) {
    ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
    ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    ::execv(arguments[0], arguments.data());
    ::_exit(127);
  }
  int status = 0;
  rusage usage{};
  REQUIRE(::wait4(process, &status, 0, &usage) == process);
  Outcome outcome;
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  outcome.err = file_contents(err);
  outcome.peak_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  return outcome;
}

const std::string kInfo = PROGRAMS "/svnet-info", kRender = PROGRAMS "/svnet-render";

void check_refused(const Attack& attack, const Outcome& outcome, std::uint64_t base_bytes) {
  CAPTURE(attack.name, outcome.err, outcome.seconds, outcome.peak_bytes >> 20, base_bytes >> 20);
  CHECK(outcome.status == 1);
  CHECK(outcome.err.find(attack.file.string()) != std::string::npos);
  for (const char* unclear : {"terminate", "std::", "bad_alloc", "basic_string", "vector::", "no reason"})
    CHECK(outcome.err.find(unclear) == std::string::npos);
  if (kSanitized) return;  // they add lines of their own, and memory
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  CHECK(outcome.err.size() < 1000);
  constexpr std::uint64_t kAllowance = std::uint64_t{64} << 20;
  CHECK(outcome.peak_bytes < base_bytes + kAllowance + 2 * attack.bytes);
  CHECK(outcome.seconds < 20);  // a few seconds, on a machine that does other work
}

}  // namespace

TEST_CASE("HDF5 files that attack are refused, each in one line") {
  const TemporaryFolder folder;
  const std::vector<Attack> attacks = write_hdf5_attacks(folder.path() / "hdf5");
  CHECK(attacks.size() >= 60);
  const Outcome good = run({kInfo, FIXTURES "/io/keras_legacy.h5"});
  REQUIRE(good.status == 0);
  for (const Attack& attack : attacks) check_refused(attack, run({kInfo, attack.file}), good.peak_bytes);
}

TEST_CASE("meshes that attack are refused, each in one line") {
  const TemporaryFolder folder;
  const std::vector<Attack> attacks = write_mesh_attacks(folder.path() / "meshes");
  CHECK(attacks.size() >= 60);
  const fs::path out = folder.path() / "out";
  const auto render = [&](const fs::path& collection) {
    return run({kRender, "--quiet", "--poses", "1", "--size", "32", "--meshes", collection, "--output", out});
  };
  folder.write("good/things/a.obj", "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const Outcome good = render(folder.path() / "good");
  CHECK(good.status == 0);
  fs::remove_all(out);
  for (const Attack& attack : attacks) {
    check_refused(attack, render(attack.file), good.peak_bytes);
    CHECK_FALSE(fs::exists(out));
    fs::remove_all(out);
  }
}
