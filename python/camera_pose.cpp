#include "arguments.h"
#include "base/error.h"
#include "bindings.h"
#include "view/camera.h"

namespace svnet::python {
using view::CameraFrame;

namespace {

namespace py = pybind11;

constexpr const char* kDoc = R"(camera_pose(theta_deg, phi_deg, radius, centre, frame="paper")
--

The camera-to-world transform of a camera on the upper half-sphere around `centre`, looking at it.

theta_deg, phi_deg : azimuth from the world's x axis and elevation above the table, in degrees; phi in [0, 90].
radius : metres, positive. centre : (3,) array-like, metres; the world's z axis is vertical.
frame : the camera's axes. "paper": z forward, x level and to the left of the image, y upwards. "optical" (ROS,
REP-103): z forward, x right, y down.
Returns (4, 4) float64. It maps a point of the camera's frame to the world: camera_pose(...) @ [x, y, z, 1].
Raises svnet.Error if an angle is out of range, a length is not finite, radius is not positive, or frame is unknown.
)";

py::array_t<double> pose_matrix(const py::object& theta_deg, const py::object& phi_deg, const py::object& radius,
                                const py::object& centre, const py::object& frame) {
  constexpr const char* kFunction = "camera_pose";
  const view::CameraPose pose{number(kFunction, "theta_deg", theta_deg), number(kFunction, "phi_deg", phi_deg)};
  const double radius_m = number(kFunction, "radius", radius);
  const auto [x, y, z] = point(kFunction, "centre", centre);
  const CameraFrame axes =
      view::camera_frame_named(text(kFunction, "frame", frame, quoted_names<CameraFrame>().c_str()));
  const Eigen::Matrix4d matrix = view::look_at(pose, radius_m, {x, y, z}, axes).matrix();
  py::array_t<double> result({4, 4});
  for (Eigen::Index row = 0; row < 4; ++row)
    for (Eigen::Index column = 0; column < 4; ++column) result.mutable_at(row, column) = matrix(row, column);
  return result;
}

}  // namespace

void bind_camera_pose(py::module_& module) {
  module.def("camera_pose", pose_matrix, kDoc, py::arg("theta_deg"), py::arg("phi_deg"), py::arg("radius"),
             py::arg("centre"), py::arg("frame") = "paper");
}

}  // namespace svnet::python
