#include "base/parallel.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <span>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include <sched.h>
#include <unistd.h>

#include "base/communicator.h"
#include "base/environment.h"
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
  const std::string text = environment_variable("SVNET_THREADS");
  if (text.empty()) return affinity_count();
  char* end = nullptr;
  const long threads = std::strtol(text.c_str(), &end, 10);
  check(*end == '\0', "[SVNET_THREADS] '", text, "' is not a whole number");
  return checked_threads(threads, "SVNET_THREADS");
}

/// Tells the processor that the thread is waiting.
void relax_cpu() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

/// Waits for a condition for about as long as it takes to put a thread to sleep and wake it again: the layers of a
/// small network follow one another faster than that. Returns whether the condition holds.
template <class Condition>
bool spin_until(const Condition& condition) {
  constexpr auto kLongest = std::chrono::microseconds(50);
  const auto start = std::chrono::steady_clock::now();
  do {
    for (int i = 0; i < 32; ++i) {
      if (condition()) return true;
      relax_cpu();
    }
  } while (std::chrono::steady_clock::now() - start < kLongest);
  return false;
}

/// The chunks that one worker takes first: the i-th part of all for worker i. So in calls over the same rows, a worker
/// gets the rows that are in its cache.
struct alignas(64) Part {
  std::atomic<Index> next{0};
  Index last = 0;
};

/// One call of for_chunks, shared by the threads that work on it.
struct Job {
  Index count, chunk;
  Parallel::Body body;
  std::span<Part> parts;  // one for each worker
  std::mutex mutex{};
  std::exception_ptr error{};
  Index error_chunk = std::numeric_limits<Index>::max();

  /// Runs the remaining chunks of the worker's own part, then those of the other parts.
  void work(int worker) {
    InsideBody inside;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      Part& part = parts[(static_cast<std::size_t>(worker) + i) % parts.size()];
      for (Index k; (k = part.next.fetch_add(1, std::memory_order_relaxed)) < part.last;) run(k, worker);
    }
  }

  void run(Index k, int worker) {
    try {
      body(k * chunk, std::min(count, (k + 1) * chunk), worker);
    } catch (...) {
      std::lock_guard lock(mutex);
      if (k < error_chunk) {
        error_chunk = k;
        error = std::current_exception();
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
  std::vector<Part> parts;  // of the open call
  std::atomic<int> threads{1};
  /// The number of the call, whether helpers may still join it, and how many have joined. A call closes when its caller
  /// finds no chunk left, and ends when the last helper that joined has left. It never waits for other helpers.
  std::atomic<std::uint64_t> state{0};
  std::atomic<int> running{0};             // helpers that have started
  std::atomic<int> sleepers{0};            // helpers that must be woken
  std::atomic<bool> caller_sleeps{false};  // the last helper to leave must wake the caller
  std::atomic<bool> stop{false};
  Job* job = nullptr;  // of the open call: written before it opens, read by helpers that are in it
  bool may_spin = false;
  const pid_t process = getpid();

  static constexpr std::uint64_t kInside = 0x7fffffff, kOpen = kInside + 1, kCall = kOpen << 1;

  /// A forked process has the handles of the helper threads, but not the threads.
  bool forked() const { return getpid() != process; }

  /// Throws Error if the system cannot start that many threads; then there are no helpers.
  void start(int count) {
    parts = std::vector<Part>(static_cast<std::size_t>(count));
    stop = false;
    may_spin = count <= affinity_count();
    try {
      for (int worker = 1; worker < count; ++worker) helpers.emplace_back([this, worker] { help(worker); });
    } catch (const std::system_error& error) {
      join();
      fail("[threads] cannot start ", count, " threads: ", error.code().message());
    }
    threads = count;
#ifdef SVNET_SANITIZED
    // While a thread starts, it holds a lock of the address sanitizer's allocator. In a process that is forked then,
    // the lock stays held, and the next allocation waits for ever.
    while (running < count - 1) std::this_thread::yield();
#endif
  }

  /// Whether there is an open call that a helper has not joined yet. `seen`: the last one it joined.
  static bool is_new_call(std::uint64_t now, std::uint64_t seen) { return (now & kOpen) != 0 && now / kCall != seen; }

  void help(int worker) {
    ++running;
    for (std::uint64_t seen = 0;;) {
      const auto called = [&] { return stop.load() || is_new_call(state.load(), seen); };
      if (!(may_spin && spin_until(called))) {
        std::unique_lock lock(mutex);
        ++sleepers;  // before the last look at the state: the caller opens a call first and then looks for sleepers
        wake.wait(lock, called);
        --sleepers;
      }
      if (stop) return;
      std::uint64_t now = state.load();
      while (is_new_call(now, seen) && !state.compare_exchange_weak(now, now + 1)) {
      }
      if (!is_new_call(now, seen)) continue;
      seen = now / kCall;
      job->work(worker);
      const std::uint64_t left = --state;
      if ((left & (kOpen | kInside)) == 0 && caller_sleeps) {
        { std::lock_guard lock(mutex); }  // the caller waits by now, or has yet to look
        done.notify_one();
      }
    }
  }

  /// Runs the chunks [first, last).
  void run(Job& whole, Index first, Index last) {
    const Index workers = static_cast<Index>(parts.size()), chunks = last - first;
    for (Index i = 0; i < workers; ++i) {
      Part& part = parts[static_cast<std::size_t>(i)];
      part.next.store(first + chunks * i / workers, std::memory_order_relaxed);
      part.last = first + chunks * (i + 1) / workers;
    }
    whole.parts = parts;
    job = &whole;
    state = (state.load() / kCall + 1) * kCall | kOpen;
    if (sleepers > 0) {
      { std::lock_guard lock(mutex); }
      wake.notify_all();
    }
    whole.work(0);
    state &= ~kOpen;
    const auto empty = [&] { return (state.load() & kInside) == 0; };
    if (empty() || (may_spin && spin_until(empty))) return;
    std::unique_lock lock(mutex);
    caller_sleeps = true;
    done.wait(lock, empty);
    caller_sleeps = false;
  }

  void join() {
    {
      std::lock_guard lock(mutex);
      stop = true;
    }
    wake.notify_all();
    for (auto& helper : helpers) helper.join();
    helpers.clear();
    running = 0;
  }
};

Parallel::Parallel(int threads)
    : pool_(new Pool, [](Pool* pool) {
        if (pool->forked()) return;  // its threads can be neither joined nor destroyed
        pool->join();
        delete pool;
      }) {
  pool_->start(checked_threads(threads, "threads"));
}

Parallel Parallel::share(const Communicator& communicator) const { return {pool_, communicator}; }

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
  try {
    pool_->start(threads);
  } catch (const Error&) {
    pool_->start(pool_->threads);
    throw;
  }
}

void Parallel::for_chunks(Index count, Index chunk, Body body) {
  if (count <= 0) return;
  chunk = std::max<Index>(chunk, 1);
  Index first = 0, chunks = (count + chunk - 1) / chunk;
  if (communicator_ != nullptr) {
    const Share share = share_of(*communicator_, 0, static_cast<std::uint64_t>(chunks));
    first = static_cast<Index>(share.first);
    chunks = static_cast<Index>(share.last);
  }
  Job job{.count = count, .chunk = chunk, .body = body, .parts = {}};
  std::unique_lock call(pool_->call, std::defer_lock);
  if (chunks - first > 1 && !inside_body && !pool_->forked() && call.try_lock() && !pool_->helpers.empty()) {
    pool_->run(job, first, chunks);
  } else {
    InsideBody inside;
    for (Index k = first; k < chunks; ++k) job.run(k, 0);
  }
  if (job.error) std::rethrow_exception(job.error);
}

Parallel& Parallel::shared() {
  static Parallel pool(initial_threads());
  return pool;
}

}  // namespace svnet
