#pragma once
#include <shared_mutex>

namespace svnet {

/// While an object of this class exists, the number of threads of Parallel::shared() does not change: algorithms keep
/// memory per thread between two calls. For interfaces that let any thread change the number (C, Python). Objects may
/// be nested in one thread.
class FixedThreads {
 public:
  FixedThreads();
  ~FixedThreads();
  FixedThreads(const FixedThreads&) = delete;
  FixedThreads& operator=(const FixedThreads&) = delete;

 private:
  std::shared_lock<std::shared_mutex> lock_;
};

/// Waits until no FixedThreads exists, then resizes Parallel::shared(). Throws Error like Parallel::resize, and if one
/// exists in this thread, which would wait for itself.
void change_threads(int threads);

}  // namespace svnet
