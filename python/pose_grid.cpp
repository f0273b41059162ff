#include "view/pose_grid.h"

#include <limits>

#include "arguments.h"
#include "bindings.h"

namespace svnet::python {
namespace {

namespace py = pybind11;

constexpr const char* kPoseGridDoc =
    R"(pose_grid(theta_steps=36, phi_steps=10, lowest_phi_deg=0, highest_phi_deg=90)
--

The camera poses of a grid, sorted by elevation, then azimuth: theta_steps azimuths (1 to 3600), evenly from 0, at each
of phi_steps elevations (1 to 1000), evenly from lowest_phi_deg to highest_phi_deg, both included; with one step the
lowest alone. At 90 degrees there is one pose, (90, 90).

Returns (M, 2) float64: theta and phi in degrees, as Model.score takes them.
Raises svnet.Error for numbers that are out of range.
)";

py::array_t<double> pose_grid_of(const py::object& theta_steps, const py::object& phi_steps,
                                 const py::object& lowest_phi_deg, const py::object& highest_phi_deg) {
  constexpr const char* kName = "pose_grid";
  constexpr std::uint64_t kMost = std::numeric_limits<std::int32_t>::max();
  const view::GridSpec spec{static_cast<Index>(whole_number(kName, "theta_steps", theta_steps, 0, kMost)),
                            static_cast<Index>(whole_number(kName, "phi_steps", phi_steps, 0, kMost)),
                            number(kName, "lowest_phi_deg", lowest_phi_deg),
                            number(kName, "highest_phi_deg", highest_phi_deg)};
  const std::vector<view::CameraPose> poses = view::pose_grid(spec);
  py::array_t<double> angles({static_cast<py::ssize_t>(poses.size()), py::ssize_t{2}});
  double* out = angles.mutable_data();
  for (const view::CameraPose& pose : poses) {
    *out++ = pose.theta_deg;
    *out++ = pose.phi_deg;
  }
  return angles;
}

}  // namespace

void bind_pose_grid(py::module_& module) {
  module.def("pose_grid", pose_grid_of, kPoseGridDoc, py::arg("theta_steps") = 36, py::arg("phi_steps") = 10,
             py::arg("lowest_phi_deg") = 0, py::arg("highest_phi_deg") = 90);
}

}  // namespace svnet::python
