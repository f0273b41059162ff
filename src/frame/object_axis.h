#pragma once
#include "base/enum_names.h"
#include "frame/silhouette.h"

namespace svnet::frame {

/// Whether an axis was found:
///   found    the silhouette has a principal axis
///   round    it is about as wide as long (e >= .85), so its axis means little
///   unclear  it is not one whole object: hardly anything or nearly everything differs from the table, the silhouette
///            covers much of the circle's rim, or it falls into patches of like size far from each other
enum class AxisKind { found, round, unclear };
constexpr auto enum_table(AxisKind) {
  return std::to_array<EnumName<AxisKind>>(
      {{AxisKind::found, "found"}, {AxisKind::round, "round"}, {AxisKind::unclear, "unclear"}});
}

/// The principal axis of an object seen from above. With λ1 >= λ2 the eigenvalues of the second moments of its cells:
struct ObjectAxis {
  AxisKind kind = AxisKind::unclear;
  /// The azimuth in [0, 360) to which the heavy end points, in the world of a top view 90_90: the right of the image
  /// is -x (180), its lower side +y (90).
  double direction_deg = 0;
  double elongation = 1;  ///< e = √(λ2 / λ1) in [0, 1]: small for a long thin object, 1 for a disc or a square
  double skew = 0;        ///< s = (centroid - middle of the extent) / extent along the axis, in [0, .5)
  double fill = 0;        ///< the silhouette's share of the inscribed circle
  double length = 0;      ///< extent along the axis, as a share of the side of the image's centred square
  double width = 0;       ///< extent across it, as a share of that side
};

/// Measures the silhouette. Other fields than the kind describe what there is if the kind is not `found`: all patches
/// together, or nothing (the defaults) if the silhouette is empty. Turning the silhouette by a quarter turn
/// counter-clockwise adds 90 degrees to the direction, up to rounding, and changes nothing else.
ObjectAxis axis_of(const Silhouette&);

}  // namespace svnet::frame
