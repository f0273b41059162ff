#pragma once
#include <pybind11/pybind11.h>

#include "base/fixed_threads.h"

namespace svnet::python {

/// While it lives, the calling thread computes: it has released the GIL, and the number of threads stays as it is.
/// Nothing of Python may be touched meanwhile. One may live inside another: a signal handler that let_python_interrupt
/// runs may compute.
class Computing {
  pybind11::gil_scoped_release release_;  // before the threads: whoever waits for them must not hold the GIL
  FixedThreads threads_;
};

/// Waits until nobody computes, then changes the number of threads. Called with the GIL. Throws Error outside [1,
/// 1024], and in a signal handler that interrupts a computation.
void set_threads(int threads);

/// Raises KeyboardInterrupt, or whatever a signal handler raises. Called while computing, as often as convenient: it
/// waits for the GIL at most every 20 ms.
void let_python_interrupt();

}  // namespace svnet::python
