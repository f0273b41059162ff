#pragma once
#include <shared_mutex>

namespace svnet {

/// Keeps the number of threads of Parallel::shared() while an object of this class exists. Computations hold one,
/// because algorithms keep memory per thread between two calls. For interfaces (C, Python) in which any thread may
/// change the number. One thread may hold several objects.
class FixedThreads {
 public:
  FixedThreads();
  ~FixedThreads();
  FixedThreads(const FixedThreads&) = delete;
  FixedThreads& operator=(const FixedThreads&) = delete;

 private:
  std::shared_lock<std::shared_mutex> lock_;
};

/// Waits until no FixedThreads exists, then resizes Parallel::shared(). Throws Error as Parallel::resize does. Also
/// throws Error if this thread holds a FixedThreads, because it would wait for itself.
void change_threads(int threads);

}  // namespace svnet
