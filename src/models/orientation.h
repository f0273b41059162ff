#pragma once
#include "base/index.h"

namespace svnet {

/// The ways in which a square picture from above can lie: turned by quarter turns, as taken or mirrored. Turning the
/// picture turns the object, and with it the azimuths of all its views; so each orientation is an example of its own.
/// Number 0 is the picture as taken; n is mirrored left to right for n >= 4, then turned n % 4 quarters
/// counter-clockwise.
inline constexpr int kOrientations = 8;

/// The pixels (side, side, 3) in another orientation. from and to are different memory.
void orient(int orientation, Index side, const float* from, float* to);

/// The azimuth, in [0, 360), from which the turned object looks as the object did from theta_deg. The picture's right
/// is an azimuth of 0 or 180 degrees, as it is of a top view 90_90 (docs/camera-convention.md).
double oriented_theta_deg(int orientation, double theta_deg);

}  // namespace svnet
