#pragma once
#include <shared_mutex>

#include <pybind11/pybind11.h>

namespace svnet::python {

/// While it lives, the calling thread computes: it has released the GIL, and the number of threads stays as it is
/// (algorithms keep memory per thread). Nothing of Python may be touched meanwhile. One may live inside another: a
/// signal handler that let_python_interrupt runs may compute.
class Computing {
 public:
  Computing();
  ~Computing();
  Computing(const Computing&) = delete;
  Computing& operator=(const Computing&) = delete;

 private:
  pybind11::gil_scoped_release release_;  // before the lock: whoever waits for the lock must not hold the GIL
  std::shared_lock<std::shared_mutex> lock_;
};

/// Waits until nobody computes, then changes the number of threads. Called with the GIL. Throws Error outside [1,
/// 1024], and in a signal handler that interrupts a computation.
void set_threads(int threads);

/// Raises KeyboardInterrupt, or whatever a signal handler raises. Called while computing, as often as convenient: it
/// waits for the GIL at most every 20 ms.
void let_python_interrupt();

}  // namespace svnet::python
