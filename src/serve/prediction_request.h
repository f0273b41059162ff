#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/exif_orientation.h"
#include "serve/camera_place.h"
#include "serve/message.h"

namespace svnet::serve {

/// What a client asks of a top image.
struct PredictionRequest {
  std::vector<view::CameraPose> poses;
  ExifOrientation exif = ExifOrientation::ignore;
  std::optional<double> depth_unit_m{};  // empty: what the file's numbers suggest
  CameraPlace place{};
};

/// Reads the fields of POST /v1/predict:
///   grid              paper: the paper's 22 poses (default); even: poses spread evenly over the half-sphere
///   count             of grid=even, 1 to `most_poses`; 400
///   lowest_phi_deg    of grid=even, the lowest elevation, [0, 90); 45
///   poses             instead of a grid: "theta,phi;theta,phi", degrees
///   exif_orientation  ignore (default), obey
///   depth_unit        as svnet-views --depth-unit
/// and those of camera_place. Throws Refusal 400 for an unknown or repeated field, a wrong value, and too many poses.
PredictionRequest prediction_request(const Fields&, Index most_poses);

}  // namespace svnet::serve
