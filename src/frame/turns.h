#pragma once
#include <array>
#include <vector>

#include "image/image.h"
#include "view/camera_pose.h"

// A top view as the candidate cameras around the object see it, in a fixed number of turns.
//
// Let F(θ) be values of the top image turned to the azimuth θ (turned_image.h), and M(θ) those of the mirror image of
// this turned image. A head sees their mean, ½ F(θ) + ½ M(θ): so an object and its mirror image have the same values in
// mirrored azimuths. F and M are each known at 8 azimuths, 45° apart, and interpolated linearly between them over the
// whole turn. The azimuths of M are the mirrored ones of F, and lie between them:
//   F at 11.25° + k 45°      M at -11.25° + k 45°
// Together these are 16 turns, one every 22.5°: the least that is exact both if an object is mirrored and if it is
// turned by a quarter turn. What varies with cos mα around the object is seen times sinc²(m / 8) (the triangle that
// interpolates): .81 for m = 2 and .41 for m = 4, which a linear head can make up for. At other angles the values are
// those of the turned object up to what is aliased: 2 % of m = 2 and 11 % of m = 4.
namespace svnet::frame {

inline constexpr int kTurns = 16;

struct Turn {
  double theta_deg = 0;      ///< the azimuth of the camera at the lower edge, in [0, 360)
  bool is_mirrored = false;  ///< left and right are exchanged after turning
};

/// All turns, in ascending order of their azimuths.
std::array<Turn, kTurns> turns();

/// The top image in every turn: squares of one size, at most `side` pixels wide. A larger image is first reduced to
/// `side` by the mean over the area of each pixel, which is exact in quarter turns. Throws Error as turned_image does,
/// and unless `side` is positive.
std::vector<Image> turned_images(const Image& top_image, Index side);

/// The weight of each turn in the values that a camera pose sees; they add up to 1. The top view (φ >= 89.5°) has no
/// azimuth: it sees the mean of all turns. Poses a whole turn apart have the same weights, up to rounding.
std::array<double, kTurns> turn_weights(const view::CameraPose& pose);

}  // namespace svnet::frame
