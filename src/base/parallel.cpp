#include "base/parallel.h"

#include <atomic>
#include <condition_variable>
#include <cstdlib>
#include <exception>
#include <limits>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <sched.h>
#include <unistd.h>

#include "base/error.h"

namespace svnet {
namespace {

thread_local bool inside_body = false;

/// Marks the calling thread as running bodies, so that nested calls run inline.
class InsideBody {
 public:
  InsideBody() : before_(inside_body) { inside_body = true; }
  ~InsideBody() { inside_body = before_; }
  InsideBody(const InsideBody&) = delete;
  InsideBody& operator=(const InsideBody&) = delete;

 private:
  bool before_;
};

int affinity_count() {
  cpu_set_t mask;
  CPU_ZERO(&mask);
  if (sched_getaffinity(0, sizeof mask, &mask) != 0) return 1;
  return std::max(1, CPU_COUNT(&mask));
}

int checked_threads(long threads, const char* where) {
  check(threads >= 1 && threads <= 1024, "[", where, "] number of threads must be between 1 and 1024");
  return static_cast<int>(threads);
}

int initial_threads() {
  const char* text = std::getenv("SVNET_THREADS");
  if (text == nullptr || *text == '\0') return affinity_count();
  char* end = nullptr;
  const long threads = std::strtol(text, &end, 10);
  check(*end == '\0', "[SVNET_THREADS] '", text, "' is not a whole number");
  return checked_threads(threads, "SVNET_THREADS");
}

/// One call of for_chunks, shared by the threads that work on it.
struct Job {
  Index count, chunk, chunks;
  Parallel::Body body;
  std::atomic<Index> next{0};
  std::mutex mutex{};
  std::exception_ptr error{};
  Index error_chunk = std::numeric_limits<Index>::max();

  void work(int worker) {
    InsideBody inside;
    for (Index i; (i = next.fetch_add(1, std::memory_order_relaxed)) < chunks;) {
      try {
        body(i * chunk, std::min(count, (i + 1) * chunk), worker);
      } catch (...) {
        std::lock_guard lock(mutex);
        if (i < error_chunk) {
          error_chunk = i;
          error = std::current_exception();
        }
      }
    }
  }
};

}  // namespace

struct Parallel::Pool {
  std::mutex call;  // held for the length of one parallel call
  std::mutex mutex{};
  std::condition_variable wake, done;
  std::vector<std::thread> helpers;
  std::atomic<int> threads{1};
  Job* job = nullptr;
  std::uint64_t generation = 0;
  int running = 0;
  bool stop = false;
  const pid_t process = getpid();

  /// A forked process has no helpers, only their handles: there is nobody to wake and nobody to join.
  bool forked() const { return getpid() != process; }

  void start(int count) {
    threads = count;
    stop = false;
    for (int worker = 1; worker < count; ++worker)
      helpers.emplace_back([this, worker, seen = generation]() mutable {
        std::unique_lock lock(mutex);
        for (;;) {
          wake.wait(lock, [&] { return stop || generation != seen; });
          if (stop) return;
          seen = generation;
          Job* mine = job;
          lock.unlock();
          mine->work(worker);
          lock.lock();
          if (--running == 0) done.notify_one();
        }
      });
  }

  void join() {
    {
      std::lock_guard lock(mutex);
      stop = true;
    }
    wake.notify_all();
    for (auto& helper : helpers) helper.join();
    helpers.clear();
  }
};

Parallel::Parallel(int threads) : pool_(std::make_unique<Pool>()) { pool_->start(checked_threads(threads, "threads")); }

Parallel::~Parallel() {
  if (pool_->forked())
    static_cast<void>(pool_.release());  // its threads can be neither joined nor destroyed
  else
    pool_->join();
}

int Parallel::threads() const { return pool_->threads; }

void Parallel::resize(int threads) {
  checked_threads(threads, "threads");
  check(!inside_body, "[threads] cannot change the number of threads from inside a parallel body");
  if (pool_->forked()) {
    pool_->threads = threads;
    return;
  }
  std::lock_guard call(pool_->call);
  pool_->join();
  pool_->start(threads);
}

void Parallel::for_chunks(Index count, Index chunk, Body body) {
  if (count <= 0) return;
  chunk = std::max<Index>(chunk, 1);
  const Index chunks = (count + chunk - 1) / chunk;
  Job job{.count = count, .chunk = chunk, .chunks = chunks, .body = body};
  std::unique_lock call(pool_->call, std::defer_lock);
  if (chunks > 1 && !inside_body && !pool_->forked() && call.try_lock() && !pool_->helpers.empty()) {
    {
      std::lock_guard lock(pool_->mutex);
      pool_->job = &job;
      pool_->running = static_cast<int>(pool_->helpers.size());
      ++pool_->generation;
    }
    pool_->wake.notify_all();
    job.work(0);
    std::unique_lock lock(pool_->mutex);
    pool_->done.wait(lock, [&] { return pool_->running == 0; });
  } else {
    job.work(0);
  }
  if (job.error) std::rethrow_exception(job.error);
}

Parallel& Parallel::shared() {
  static Parallel pool(initial_threads());
  return pool;
}

}  // namespace svnet
