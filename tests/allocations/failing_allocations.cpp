// failing_allocations SEEDS [STEP [NAME]]: loads every format while the first allocation fails, then the second, until
// it succeeds, and the same with all allocations from that one on failing. STEP: one of so many, if not each. Each
// attempt has to end with std::bad_alloc, an Error that says that memory is missing, or what the load gives otherwise;
// without a crash, a hang, a leak or a partial file. Afterwards the load has to work.
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <map>
#include <new>
#include <stdexcept>

#include <dlfcn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"
#include "loads.h"
#include "temporary_folder.h"

namespace svnet::allocations {
namespace {

constexpr unsigned kPatience_s = 30;

/// What the process that makes the attempts has done. Shared with it, so that it outlives a crash.
struct Progress {
  std::size_t number = 0;  // of the allocation that fails in this attempt
  std::size_t failed = 0, errors = 0, results = 0;
  std::size_t step = 1;  // to the next attempt
  bool is_done = false;
  bool is_own = false;              // whether no library can be the reason for the finding
  std::array<char, 300> finding{};  // of this attempt
};

void find(Progress& progress, const std::string& text) {
  std::snprintf(progress.finding.data(), progress.finding.size(), "%s", text.c_str());
}

bool says_memory(std::string_view text) {
  return text.find("memory") != text.npos || text.find("allocat") != text.npos;
}

/// The library among whose functions an allocation failed, if it is one that is known not to survive that; else empty.
/// nlohmann::json allocates in its destructor and std::filesystem::directory_iterator in functions that are noexcept:
/// both end the process. A json that cannot be built leaks its parts. libwebp calls some failures damage of the file,
/// and libtiff leaks. fork of glibc may allocate in the child before it returns, and ends it.
std::string frail_library(std::span<void* const> stack) {
  for (void* address : stack) {
    Dl_info place{};
    if (::dladdr(address, &place) == 0) continue;
    const std::string_view function = place.dli_sname != nullptr ? place.dli_sname : "", file = place.dli_fname;
    if (function.find("nlohmann") != function.npos) return "nlohmann::json";
    if (function.find("libc_fork") != function.npos) return "fork of glibc";
    if (function.find("directory_iterator") != function.npos) return "std::filesystem::directory_iterator";
    for (const char* library : {"libhdf5", "libwebp", "libtiff"})
      if (file.find(library) != file.npos) return library;
  }
  return {};
}

/// The same for all allocations that failed, of which the first and the last are known.
std::string frail_library(const Load& load, bool is_crash) {
  if (is_crash && load.destroys_json) return "nlohmann::json";
  if (load.is_alone) return "libhdf5 in svnet's process";
  const std::string first = frail_library(first_failed_stack());
  return first.empty() ? frail_library(last_failed_stack()) : first;
}

/// The functions that asked for the allocation that failed last.
std::string failed_functions() {
  std::string text;
  int count = 0;
  for (void* address : last_failed_stack()) {
    Dl_info place{};
    if (::dladdr(address, &place) == 0 || ++count <= 3 || count > 12) continue;
    if (count > 4) text += " < ";
    // Functions of one file have no name here, but addr2line knows it.
    text += place.dli_sname != nullptr
                ? std::string(place.dli_sname)
                : joined(std::hex, static_cast<char*>(address) - static_cast<char*>(place.dli_fbase), std::dec);
  }
  return text;
}

/// Whether an allocation failed.
bool attempt(const Load& load, std::size_t number, Kind kind, std::uint64_t expected, Progress& progress) {
  std::array<char, 250> wrong{};
  bool is_error = true;
  std::uint64_t result = expected;
  const auto keep = [&](const char* text) { std::snprintf(wrong.data(), wrong.size(), "%s", text); };
  fail_at(number, load.where, kind);
  try {
    result = load.run();
    is_error = false;
  } catch (const std::bad_alloc&) {
  } catch (const Error& error) {
    if (!says_memory(error.what())) keep(error.what());
  } catch (const std::exception& error) {
    keep("an exception of another kind: ");
    std::strncat(wrong.data(), error.what(), wrong.size() - std::strlen(wrong.data()) - 1);
  }
  const bool has_failed = end_failures();
  if (!has_failed) return false;
  ++(is_error ? progress.errors : progress.results);
  ++progress.failed;
  if (wrong[0] != '\0') find(progress, joined("the error does not say that memory is missing: ", wrong.data()));
  if (result != expected) find(progress, "another result");
  if (const std::string problem = load.problem(); !problem.empty()) {
    find(progress, problem);
    progress.is_own = true;
  }
  return true;
}

/// Whether the attempt leaves more allocations behind each time. Once is what libraries keep.
bool leaks(const Load& load, std::size_t number, Kind kind, std::uint64_t expected) {
  for (int i = 0; i < 3; ++i) {
    Progress ignored;
    const std::ptrdiff_t before = live_allocations();
    attempt(load, number, kind, expected, ignored);
    if (live_allocations() <= before) return false;
  }
  return true;
}

/// Attempts from progress.number on, progress.step apart; stops after one with a finding.
void make_attempts(const Load& load, Kind kind, Progress& progress) {
  ::alarm(kPatience_s);
  load.run();
  const std::uint64_t expected = load.run();
  for (;; progress.number += progress.step) {
    ::alarm(kPatience_s);
    const std::ptrdiff_t before = live_allocations();
    const bool has_failed = attempt(load, progress.number, kind, expected, progress);
    if (has_failed && live_allocations() > before && leaks(load, progress.number, kind, expected))
      find(progress, "leaks memory");
    if ((!has_failed || progress.step > 1) && load.run() != expected) find(progress, "another result afterwards");
    if (progress.finding[0] != '\0') return;
    if (!has_failed) break;
    if (load.is_alone) return;
  }
  progress.is_done = true;
}

struct Sums {
  std::size_t failed = 0, errors = 0, results = 0, findings = 0;
  std::map<std::string, std::size_t> in_libraries{};
};

/// Makes the attempts of a load in a process of their own, and in another one after each finding.
void run(const Load& load, Kind kind, std::size_t step, Sums& sums) {
  void* memory = ::mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::runtime_error("no shared memory");
  auto& progress = *new (memory) Progress;
  progress.step = step;
  constexpr std::size_t kMostFindings = 20;
  constexpr int kMostAgain = 3;
  int again = 0;
  std::size_t findings = 0;
  for (progress.number = 1; !progress.is_done && findings < kMostFindings; progress.number += step) {
    progress.finding[0] = '\0';
    progress.is_own = false;
    const pid_t child = ::fork();
    if (child == 0) {
      std::set_terminate(std::abort);  // the usual handler allocates
      try {
        make_attempts(load, kind, progress);
      } catch (const std::exception& error) {
        find(progress, joined("fails without a failing allocation: ", error.what()));
      }
      ::_exit(0);
    }
    int status = 0;
    if (child < 0 || ::waitpid(child, &status, 0) < 0) throw std::runtime_error("no process for the attempts");
    const bool is_aborted = WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT;
    if (WIFSIGNALED(status)) {
      if (WTERMSIG(status) == SIGALRM) progress.is_own = true;
      ++progress.failed;
      find(progress, WTERMSIG(status) == SIGALRM ? "hangs" : joined("crashes (", ::strsignal(WTERMSIG(status)), ")"));
    }
    if (progress.finding[0] == '\0') continue;
    // Sometimes it is not known who asked. Then the attempt is made again.
    if (!progress.is_own && first_failed_stack().empty() && again < kMostAgain) {
      ++again;
      progress.number -= progress.step;
      continue;
    }
    again = 0;
    if (const std::string library = frail_library(load, is_aborted); !progress.is_own && !library.empty()) {
      ++sums.in_libraries[library];
      continue;
    }
    ++findings;
    std::cout << "  allocation " << progress.number << (kind == Kind::once ? "" : " and all later ones") << ": "
              << progress.finding.data() << "; asked for by " << failed_functions() << std::endl;
  }
  sums.failed += progress.failed;
  sums.errors += progress.errors;
  sums.results += progress.results;
  sums.findings += findings;
  ::munmap(memory, sizeof(Progress));
}

}  // namespace
}  // namespace svnet::allocations

int main(int argc, char** argv) {
  using namespace svnet::allocations;
  if (argc < 2) {
    std::cerr << "failing_allocations SEEDS [STEP [NAME]]\n";
    return 2;
  }
  const std::size_t step = argc > 2 ? std::max(1ul, std::strtoul(argv[2], nullptr, 10)) : 1;
  const TemporaryFolder work;
  Sums all;
  std::size_t count = 0;
  for (const Load& load : all_loads(argv[1], work.path())) {
    if (argc > 3 && load.name.find(argv[3]) == std::string::npos) continue;
    std::cout << load.name << std::flush;
    Sums sums;
    std::cout << std::endl;
    for (const Kind kind : {Kind::once, Kind::from_there_on}) run(load, kind, step, sums);
    std::cout << "  " << sums.failed << " failed: " << sums.errors << " errors, " << sums.results << " results"
              << std::endl;
    all.failed += sums.failed;
    all.errors += sums.errors;
    all.results += sums.results;
    all.findings += sums.findings;
    for (const auto& [library, number] : sums.in_libraries) all.in_libraries[library] += number;
    ++count;
  }
  for (const auto& [library, number] : all.in_libraries)
    std::cout << number << " attempts that " << library << " did not survive" << std::endl;
  std::cout << count << " loads, " << all.failed << " failing allocations: " << all.errors << " errors, " << all.results
            << " results, " << all.findings << " findings" << std::endl;
  return all.findings == 0 && count > 0 ? 0 : 1;
}
