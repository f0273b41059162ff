#pragma once
#include "base/index.h"

namespace svnet::view {

/// The symmetries of a square top image: it can be mirrored and turned by quarter turns. Turning the image turns the
/// object, and with it the azimuths of all its views, so each symmetry gives another training example.
///
/// Symmetry 0 leaves the image as taken. Symmetry s mirrors it left to right if s >= 4, then turns it s % 4 quarters
/// counter-clockwise.
inline constexpr int kSymmetries = 8;

/// Writes the pixels (side, side, 3) of the mirrored and turned image. `from` and `to` must not overlap.
void apply_symmetry(int symmetry, Index side, const float* from, float* to);

/// The azimuth in [0, 360) from which the turned object looks as the object did from `theta_deg`. The right of the
/// image is an azimuth of 0 or 180 degrees, as in a top view 90_90 (docs/camera-convention.md).
double symmetric_theta_deg(int symmetry, double theta_deg);

}  // namespace svnet::view
