#pragma once
#include <memory>

#include "base/function_ref.h"
#include "base/index.h"

namespace svnet {

class Communicator;

/// A thread pool. It cuts ranges into chunks whose boundaries do not depend on the number of threads. So work that
/// writes per chunk, or sums per chunk in order, gives the same bits for any number of threads.
///
/// Safe to call from several threads. A call runs all its chunks on the calling thread if the pool is busy, if it comes
/// from inside a body, or if the process was forked after the pool was made.
class Parallel {
 public:
  /// body(begin, end, worker). `worker` is in [0, threads()). Within one call, bodies that run at the same time have
  /// different workers, so it can index scratch memory.
  using Body = FunctionRef<void(Index begin, Index end, int worker)>;

  explicit Parallel(int threads);
  Parallel(const Parallel&) = delete;
  Parallel& operator=(const Parallel&) = delete;

  int threads() const;
  /// Waits for a running call, then changes the number of threads. Throws Error outside [1, 1024], and if the system
  /// cannot start that many; then the number does not change.
  void resize(int threads);

  /// Runs body on [0, chunk), [chunk, 2 chunk), … up to `count`, in any order, and returns when all are done.
  /// Worker i starts with the i-th part of the chunks, then takes chunks of other parts. So calls over the same rows
  /// find them in the same caches. If bodies throw, the exception of the lowest chunk is rethrown. Allocates nothing.
  void for_chunks(Index count, Index chunk, Body body);

  /// Returns the same pool, but each call runs only this process's share of the chunks. Requires: chunks write to
  /// different places. The caller exchanges the results afterwards. The communicator must outlive the returned object.
  Parallel share(const Communicator& communicator) const;

  /// The pool of the process. At first use it gets SVNET_THREADS threads, or as many as the affinity mask has CPUs.
  static Parallel& shared();

 private:
  struct Pool;
  Parallel(std::shared_ptr<Pool> pool, const Communicator& communicator)
      : pool_(std::move(pool)), communicator_(&communicator) {}

  std::shared_ptr<Pool> pool_;
  const Communicator* communicator_ = nullptr;
};

}  // namespace svnet
