#pragma once
#include <array>
#include <string>
#include <string_view>

namespace svnet {

/// A unit in which depth is stored, in metres.
struct DepthUnit {
  std::string_view name;
  double metres;
};

/// The units that cameras and programs write: NumPy and ROS floats (m), most cameras and ROS integers (mm), RealSense
/// L515 (0.25mm), TUM RGB-D (0.2mm), RealSense D405 and ScanNet-like tools (0.1mm).
inline constexpr std::array<DepthUnit, 6> kDepthUnits{
    {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"0.25mm", 0.00025}, {"0.2mm", 0.0002}, {"0.1mm", 0.0001}}};

/// Metres per unit of depth from text: "m", "cm", "mm" or "um", with a factor before it if it is not 1 ("0.25mm"), or a
/// number alone, which is in metres ("0.00025"). Throws Error for other text, and outside 1e-6 to 1 m.
double depth_unit_m(std::string_view text);

/// The name of a unit of kDepthUnits, or "0.0005 m" for another length.
std::string depth_unit_name(double metres);

}  // namespace svnet
