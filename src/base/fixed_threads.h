#pragma once
#include <shared_mutex>

namespace svnet {

/// While one lives, Parallel::shared() keeps its number of threads: algorithms keep memory per thread from one call of
/// it to the next. One may live inside another in the same thread. For those who let other threads change the number.
class FixedThreads {
 public:
  FixedThreads();
  ~FixedThreads();
  FixedThreads(const FixedThreads&) = delete;
  FixedThreads& operator=(const FixedThreads&) = delete;

 private:
  std::shared_lock<std::shared_mutex> lock_;
};

/// Waits until no FixedThreads lives, then resizes Parallel::shared(). Throws Error as Parallel::resize does, and where
/// one lives in this thread, which would wait for itself.
void change_threads(int threads);

}  // namespace svnet
