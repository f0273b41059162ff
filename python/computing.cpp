#include "computing.h"

#include <mutex>

#include "base/parallel.h"

namespace svnet::python {
namespace {

std::shared_mutex& threads_mutex() {
  static std::shared_mutex mutex;
  return mutex;
}

}  // namespace

Computing::Computing() : lock_(threads_mutex()) {}

void set_threads(int threads) {
  const pybind11::gil_scoped_release release;
  const std::unique_lock lock(threads_mutex());
  Parallel::shared().resize(threads);
}

void let_python_interrupt() {
  const pybind11::gil_scoped_acquire acquire;
  if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
}

}  // namespace svnet::python
