#pragma once
#include <pybind11/pybind11.h>

#include "base/fixed_threads.h"

namespace svnet::python {

/// The scope of a computation: while it exists, the calling thread has released the GIL, and the number of threads does
/// not change. Requires: no Python object is used in the scope. Scopes may be nested, because a signal handler that
/// let_python_interrupt runs may compute.
class Computing {
  pybind11::gil_scoped_release release_;  // first: a thread that waits for threads_ must not hold the GIL
  FixedThreads threads_;
};

/// Waits until no thread computes, then changes the number of threads. Requires the GIL. Throws Error if `threads` is
/// not in [1, 1024], and in a signal handler that interrupts a computation.
void set_threads(int threads);

/// Runs pending signal handlers and throws what they raise, such as KeyboardInterrupt. Called in the scope of
/// Computing. It is cheap: it takes the GIL at most every 20 ms.
void let_python_interrupt();

}  // namespace svnet::python
