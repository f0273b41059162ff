#include "computing.h"

#include <chrono>

namespace svnet::python {

void set_threads(int threads) {
  const pybind11::gil_scoped_release release;
  change_threads(threads);
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
