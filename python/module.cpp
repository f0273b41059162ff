#include <limits>

#include "arguments.h"
#include "base/cpu.h"
#include "base/error.h"
#include "base/version.h"
#include "bindings.h"
#include "computing.h"

namespace py = pybind11;

namespace {

constexpr const char* kErrorDoc = "What the caller can mend: one line that says what was wrong, where, and what to do.";

constexpr const char* kSetThreadsDoc = R"(set_threads(n)
--

Computes with n threads from now on, 1 to 1024; waits for computations that run. Results do not depend on it, bit for
bit. The default is SVNET_THREADS, else the number of CPUs that the process may use. Raises svnet.Error.
)";

void set_threads(const py::object& n) {
  const std::uint64_t threads = svnet::python::whole_number("set_threads", "n", n, 1);
  svnet::check(threads <= 1024, "[set_threads] n is ", threads, "; expects 1 to 1024");
  svnet::python::set_threads(static_cast<int>(threads));
}

}  // namespace

PYBIND11_MODULE(_svnet, module) {
  svnet::cap_from_environment();
  // Docstrings start with the signature in the form that inspect and help() read.
  py::options options;
  options.disable_function_signatures();

  auto& error = py::register_exception<svnet::Error>(module, "Error", PyExc_ValueError);
  error.attr("__module__") = "svnet";
  error.attr("__doc__") = kErrorDoc;
  module.attr("__version__") = svnet::kVersion;
  module.def("set_threads", set_threads, kSetThreadsDoc, py::arg("n"));
  svnet::python::bind_camera_pose(module);
  svnet::python::bind_clustering(module);
  svnet::python::bind_cluster_metrics(module);
  svnet::python::bind_scores(module);
  svnet::python::bind_backbone(module);
  svnet::python::bind_model(module);
  for (const char* name : {"Backbone", "Model"}) module.attr(name).attr("__module__") = "svnet";
}
