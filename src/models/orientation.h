#pragma once
#include "base/index.h"

namespace svnet {

/// The eight ways to turn or mirror a square image from above. Turning the image turns the object, and with it the
/// azimuths of all its views, so each orientation is an example of its own. Number 0 is the image as taken; number n is
/// mirrored left to right if n >= 4, then turned n % 4 quarters counter-clockwise.
inline constexpr int kOrientations = 8;

/// The pixels (side, side, 3) in another orientation. `from` and `to` must not overlap.
void orient(int orientation, Index side, const float* from, float* to);

/// The azimuth, in [0, 360), from which the turned object looks as the object did from theta_deg. Requires an
/// image like a top view 90_90, whose right is at an azimuth of 0 or 180 degrees (docs/camera-convention.md).
double oriented_theta_deg(int orientation, double theta_deg);

}  // namespace svnet
