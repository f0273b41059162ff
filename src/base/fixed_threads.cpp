#include "base/fixed_threads.h"

#include <mutex>

#include <pthread.h>

#include "base/error.h"
#include "base/parallel.h"

namespace svnet {
namespace {

thread_local int living = 0;  // of this thread, one inside the other

struct Locks {
  std::mutex entry;  // held by whoever waits for `inside`, so that those who change the number get their turn
  std::shared_mutex inside;
};

/// A forked process gets new locks: threads that it does not have may hold the old ones.
Locks& locks() {
  static Locks* current = new Locks;
  [[maybe_unused]] static const int registered = pthread_atfork(nullptr, nullptr, [] { current = new Locks; });
  return *current;
}

}  // namespace

FixedThreads::FixedThreads() {
  if (living == 0) {
    const std::lock_guard entry(locks().entry);
    lock_ = std::shared_lock(locks().inside);
  }
  ++living;
}

FixedThreads::~FixedThreads() { --living; }

void change_threads(int threads) {
  check(living == 0, "[threads] the number of threads cannot change while a computation is interrupted; change it ",
        "after it");
  const std::lock_guard entry(locks().entry);
  const std::lock_guard inside(locks().inside);
  Parallel::shared().resize(threads);
}

}  // namespace svnet
