#pragma once
#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "serve/field_values.h"
#include "view/camera.h"

namespace svnet::serve {

/// Where the half-sphere of cameras is in the world, and the axes of a camera.
struct CameraPlace {
  double radius_m = 1;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  view::CameraFrame frame = view::CameraFrame::optical;
};

/// Takes the fields radius_m, centre_m ("x,y,z") and frame (optical, paper). Throws Refusal 400 for wrong values.
CameraPlace camera_place(FieldValues&);

/// A camera in the world: frame, radius_m, centre_m, position (x_m, y_m, z_m), orientation (qx, qy, qz, qw), and
/// camera_to_world, the same as rows of a 4x4 matrix.
nlohmann::ordered_json camera_pose_json(const view::CameraPose&, const CameraPlace&);

}  // namespace svnet::serve
