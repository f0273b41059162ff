#pragma once
#include <memory>

#include "base/function_ref.h"
#include "base/index.h"

namespace svnet {

class Communicator;

/// A thread pool that cuts ranges into chunks whose boundaries never depend on the number of threads, so that work
/// which writes per chunk, or sums per chunk in order, gives the same bits for any number of threads.
///
/// Safe to call from several threads: a call that finds the pool busy, comes from inside one of its own bodies, or from
/// a process forked off the one that made the pool, runs all its chunks on the calling thread.
class Parallel {
 public:
  /// body(begin, end, worker): `worker` is in [0, threads()) and no two bodies run with the same worker at once
  /// within one call; use it to index scratch memory.
  using Body = FunctionRef<void(Index begin, Index end, int worker)>;

  explicit Parallel(int threads);
  Parallel(const Parallel&) = delete;
  Parallel& operator=(const Parallel&) = delete;

  int threads() const;
  /// Waits for a running call, then changes the number of threads. Throws Error outside [1, 1024], and where the system
  /// does not make that many; the number stays as it was then.
  void resize(int threads);

  /// Runs body on [0, chunk), [chunk, 2 chunk), … up to `count`, in any order, and returns when all are done.
  /// Worker i begins with the i-th part of the chunks and helps the others afterwards, so that calls over the same rows
  /// find them in the same caches.
  /// If bodies throw, the exception of the lowest chunk is rethrown. Allocates nothing.
  void for_chunks(Index count, Index chunk, Body body);

  /// The same threads for this process's share of the chunks of each range: for work whose chunks write apart, where
  /// the processes of the communicator gather afterwards what each has written. The communicator must outlive it.
  Parallel share(const Communicator& communicator) const;

  /// The pool of the process. It starts with SVNET_THREADS threads, or as many as the affinity mask has CPUs.
  static Parallel& shared();

 private:
  struct Pool;
  Parallel(std::shared_ptr<Pool> pool, const Communicator& communicator)
      : pool_(std::move(pool)), communicator_(&communicator) {}

  std::shared_ptr<Pool> pool_;
  const Communicator* communicator_ = nullptr;
};

}  // namespace svnet
