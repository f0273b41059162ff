#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "view/camera_pose.h"

namespace svnet::report {

struct PolarView {
  view::CameraPose pose;
  double score = 0;  ///< NaN: not known
};

/// The half-sphere of camera poses as a heat map. It lies as the top image does: the centre is the top view, azimuth 0°
/// is at the left, 90° at the bottom, 180° at the right. The distance from the centre is linear in the elevation.
struct PolarMap {
  std::string title;
  std::string alternative;  ///< the text that stands for the image
  std::vector<PolarView> views;
  /// Indices of views that are marked.
  std::optional<std::size_t> chosen{}, best{}, worst{};
  std::optional<double> axis_deg{};  ///< azimuth of the object's axis
};

/// The map as SVG, its colours from the lowest to the highest score (view/colour_scale.h), with their scale below.
/// The best view has a solid outline, the worst a dashed one, the chosen one a white dot. Requires a view.
std::string polar_map(const PolarMap& map);

}  // namespace svnet::report
