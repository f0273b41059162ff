#include "computing.h"

#include <chrono>
#include <mutex>

#include <pthread.h>

#include "base/error.h"
#include "base/parallel.h"

namespace svnet::python {
namespace {

thread_local int computations = 0;  // of this thread, one inside the other

/// Held by whoever computes, alone by whoever changes the number of threads. A forked process gets a new one: those who
/// hold the old one may be threads that it does not have.
std::shared_mutex& threads_mutex() {
  static std::shared_mutex* mutex = new std::shared_mutex;
  [[maybe_unused]] static const int registered =
      pthread_atfork(nullptr, nullptr, [] { mutex = new std::shared_mutex; });
  return *mutex;
}

}  // namespace

Computing::Computing() {
  if (computations++ == 0) lock_ = std::shared_lock(threads_mutex());
}

Computing::~Computing() { --computations; }

void set_threads(int threads) {
  check(computations == 0, "[set_threads] the number of threads cannot change while a computation is interrupted; ",
        "call set_threads after it");
  const pybind11::gil_scoped_release release;
  const std::unique_lock lock(threads_mutex());
  Parallel::shared().resize(threads);
}

void let_python_interrupt() {
  using Clock = std::chrono::steady_clock;
  thread_local Clock::time_point next_look{};
  if (Clock::now() < next_look) return;
  const pybind11::gil_scoped_acquire acquire;
  if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
  next_look = Clock::now() + std::chrono::milliseconds(20);
}

}  // namespace svnet::python
