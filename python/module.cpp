#include <exception>
#include <limits>
#include <utility>

#include <pybind11/gil_safe_call_once.h>

#include "arguments.h"
#include "base/cpu.h"
#include "base/error.h"
#include "base/version.h"
#include "bindings.h"
#include "computing.h"
#include "sandbox/mode.h"

namespace py = pybind11;

namespace {

constexpr const char* kErrorDoc =
    "An error that the caller can correct: one line that says what is wrong, where, and what to do.";

constexpr const char* kSetThreadsDoc = R"(set_threads(n)
--

Sets the number of threads of later computations, from 1 to 1024. Waits for running computations. Results have the same
bits for any number of threads. Default: SVNET_THREADS, or else the number of CPUs that the process may use.
Raises svnet.Error for another number.
)";

constexpr const char* kSetSandboxDoc = R"(set_sandbox(mode)
--

How weights in HDF5 files are read from now on. "on" (the default): the HDF5 library, which is not safe against files made
to attack it, decodes them in a child process that can do nothing else. "off": in this process, for files that you trust,
where the system allows no such processes.
Raises svnet.Error for another mode.
)";

/// Raises `type` with a message. Bytes that are not UTF-8, for example in a path, are written as \xff.
void raise_error(const py::object& type, const std::string& message) {
  const py::ssize_t size = message.size();
  const auto text = py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(message.data(), size, "backslashreplace"));
  if (text) PyErr_SetObject(type.ptr(), text.ptr());
}

/// Adds svnet.Error to the module, and translates svnet::Error to it.
void bind_error(py::module_& module) {
  PYBIND11_CONSTINIT static py::gil_safe_call_once_and_store<py::object> storage;
  const py::object& type =
      storage.call_once_and_store_result([&] { return py::exception<svnet::Error>(module, "Error", PyExc_ValueError); })
          .get_stored();
  type.attr("__module__") = "svnet";
  type.attr("__doc__") = kErrorDoc;
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(std::move(thrown));
    } catch (const svnet::Error& error) {
      raise_error(storage.get_stored(), error.what());
    }
  });
}

void set_threads(const py::object& n) {
  svnet::python::set_threads(svnet::python::whole_number("set_threads", "n", n, 1, 1024));
}

void set_sandbox(const py::object& mode) {
  using svnet::sandbox::Mode;
  const std::string name =
      svnet::python::text("set_sandbox", "mode", mode, svnet::python::quoted_names<Mode>().c_str());
  svnet::sandbox::set_mode(svnet::enum_from_name<Mode>("[set_sandbox] mode", name));
}

}  // namespace

PYBIND11_MODULE(_svnet, module) {
  svnet::cap_from_environment();
  // Docstrings start with the signature in the form that inspect and help() expect.
  py::options options;
  options.disable_function_signatures();

  bind_error(module);
  module.attr("__version__") = svnet::kVersion;
  module.def("set_threads", set_threads, kSetThreadsDoc, py::arg("n"));
  module.def("set_sandbox", set_sandbox, kSetSandboxDoc, py::arg("mode"));
  svnet::python::bind_camera_pose(module);
  svnet::python::bind_clustering(module);
  svnet::python::bind_grouping(module);
  svnet::python::bind_cluster_metrics(module);
  svnet::python::bind_scores(module);
  svnet::python::bind_backbone(module);
  svnet::python::bind_model(module);
  svnet::python::bind_pose_grid(module);
  for (const char* name : {"Backbone", "Model"}) module.attr(name).attr("__module__") = "svnet";
}
