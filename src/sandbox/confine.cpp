#include "sandbox/confine.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "base/error.h"
#include "sandbox/descriptor.h"
#include "sandbox/syscall_filter.h"

namespace svnet::sandbox {
namespace {

#ifdef SVNET_SANITIZED
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

std::string refusal(const char* what) {
  const int code = errno;
  return code != 0 ? joined(what, ": ", std::generic_category().message(code)) : what;
}

/// Descriptors from `first` to `last`, both included.
void close_range(unsigned first, unsigned last) {
  if (first > last || ::syscall(SYS_close_range, first, last, 0u) == 0) return;
  constexpr unsigned kMost = 1u << 20;  // kernels before 5.9
  const long open = ::sysconf(_SC_OPEN_MAX);
  const unsigned end = open > 0 ? std::min(static_cast<unsigned>(open), kMost) : kMost;
  for (unsigned number = first; number <= last && number < end; ++number) ::close(static_cast<int>(number));
}

void close_all_but(std::span<const int> kept) {
  std::vector<unsigned> numbers(kept.begin(), kept.end());
  if (kSanitized) numbers.push_back(2);  // for their reports
  std::sort(numbers.begin(), numbers.end());
  unsigned next = 0;
  for (const unsigned number : numbers) {
    if (number > next) close_range(next, number - 1);
    next = number + 1;
  }
  close_range(next, ~0u);
}

/// Ctrl-C reaches all processes of a terminal: what it means is the parent's matter.
void forget_signals() {
  for (int number = 1; number < 32; ++number) {
    const bool is_crash = number == SIGSEGV || number == SIGBUS || number == SIGFPE || number == SIGILL;
    if (!kSanitized || !is_crash) std::signal(number, SIG_DFL);
  }
  for (const int number : {SIGINT, SIGHUP, SIGQUIT, SIGPIPE}) std::signal(number, SIG_IGN);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// `grace`: how much more there is after the first signal, for limits that send one.
bool set_limit(int resource, std::uint64_t value, std::uint64_t grace = 0) {
  rlimit limit{};
  if (::getrlimit(static_cast<__rlimit_resource>(resource), &limit) != 0) return false;
  limit.rlim_max = std::min<rlim_t>(limit.rlim_max, value + grace);
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, value);
  return ::setrlimit(static_cast<__rlimit_resource>(resource), &limit) == 0;
}

/// The addresses that the process uses, in bytes; 0 if the system does not say. Allocates nothing.
std::uint64_t used_addresses() {
  char text[32] = "";
  const Descriptor file(::open("/proc/self/statm", O_RDONLY | O_CLOEXEC));
  if (file.number() < 0 || ::read(file.number(), text, sizeof text - 1) <= 0) return 0;
  const std::uint64_t pages = std::strtoull(text, nullptr, 10);
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

std::string confine_this_process(std::span<const int> kept, const Limits& limits) {
  const std::uint64_t used = used_addresses();
  if (used == 0) return "/proc/self/statm cannot be read";
  forget_signals();
  close_all_but(kept);
  errno = 0;
  const auto seconds = static_cast<std::uint64_t>(limits.processor_time.count());
  if (!set_limit(RLIMIT_CORE, 0) || !set_limit(RLIMIT_FSIZE, 0) || !set_limit(RLIMIT_CPU, seconds, 1))
    return refusal("limits of resources");
  if (!kSanitized && !set_limit(RLIMIT_AS, used + limits.memory_bytes)) return refusal("a limit of memory");
  if (::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0) != 0) return refusal("PR_SET_DUMPABLE");
  if (const char* refused = install_syscall_filter()) return refusal(refused);
  return {};
}

}  // namespace svnet::sandbox
