#include "failing_malloc.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>

#include <execinfo.h>
#include <sys/mman.h>
#include <unistd.h>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);
}

namespace svnet::allocations {
namespace {

std::atomic<bool> is_armed{false};
std::atomic<std::size_t> calls{0};
std::atomic<std::ptrdiff_t> live{0};
std::size_t failing = 0;
Where where = Where::here;
Kind kind = Kind::once;
pid_t owner = 0;

struct Stack {
  std::array<void*, 40> frames{};
  std::size_t depth = 0;

  std::span<void* const> used() const { return std::span(frames).first(depth); }
};

struct Failure {
  std::atomic<bool> is_met{false};
  Stack first{}, last{};
};

/// Shared with forked processes.
Failure& failure() {
  static auto* shared = [] {
    void* memory = ::mmap(nullptr, sizeof(Failure), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) std::abort();
    std::array<void*, 2> frames{};
    ::backtrace(frames.data(), 2);  // the first call allocates
    return new (memory) Failure;
  }();
  return *shared;
}

/// Whether this call fails.
bool fails() {
  if (!is_armed) return false;
  const int saved = errno;
  const bool is_here = ::getpid() == owner;  // the sandbox refuses getpid: not this process either
  errno = saved;
  if (is_here != (where == Where::here)) return false;
  const std::size_t number = ++calls;
  if (number != failing && !(kind == Kind::from_there_on && number > failing)) return false;
  Stack& last = failure().last;
  last.depth = static_cast<std::size_t>(::backtrace(last.frames.data(), static_cast<int>(last.frames.size())));
  if (!failure().is_met.exchange(true)) failure().first = last;
  errno = ENOMEM;
  return true;
}

void* counted(void* memory) {
  if (memory != nullptr) ++live;
  return memory;
}

}  // namespace

void fail_at(std::size_t number, Where chosen, Kind how) {
  failure().is_met = false;
  failure().first.depth = failure().last.depth = 0;
  calls = 0;
  failing = number;
  where = chosen;
  kind = how;
  owner = ::getpid();
  is_armed = true;
}

bool end_failures() {
  is_armed = false;
  return failure().is_met;
}

std::span<void* const> first_failed_stack() { return failure().first.used(); }
std::span<void* const> last_failed_stack() { return failure().last.used(); }

std::ptrdiff_t live_allocations() { return live; }

}  // namespace svnet::allocations

using namespace svnet::allocations;

extern "C" {
void* malloc(std::size_t bytes) { return fails() ? nullptr : counted(__libc_malloc(bytes)); }
void* calloc(std::size_t count, std::size_t bytes) { return fails() ? nullptr : counted(__libc_calloc(count, bytes)); }
void* realloc(void* memory, std::size_t bytes) {
  if (memory == nullptr) return malloc(bytes);
  if (bytes != 0 && fails()) return nullptr;
  void* moved = __libc_realloc(memory, bytes);
  if (moved == nullptr && bytes == 0) --live;
  return moved;
}
void* memalign(std::size_t alignment, std::size_t bytes) {
  return fails() ? nullptr : counted(__libc_memalign(alignment, bytes));
}
void* aligned_alloc(std::size_t alignment, std::size_t bytes) { return memalign(alignment, bytes); }
int posix_memalign(void** memory, std::size_t alignment, std::size_t bytes) {
  void* aligned = memalign(alignment, bytes);
  if (aligned == nullptr) return ENOMEM;
  *memory = aligned;
  return 0;
}
void free(void* memory) {
  if (memory != nullptr) --live;
  __libc_free(memory);
}
}
