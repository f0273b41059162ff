#pragma once
#include "simulation/scene.h"

namespace svnet {

/// What the paper's kind of RGB-D camera makes of a shot.
struct RgbdPicture {
  Image rgb;
  DepthImage depth;
};

/// The colours are blurred by the lens (Gaussian, σ 0.5 pixels), get shot noise and are written as sRGB. Depth z gets
/// Gaussian noise of σ = 1.4 mm · z² (z in metres), is rounded to millimetres, and has holes along silhouettes.
/// `exposure` multiplies the light.
RgbdPicture sensor_picture(const Shot&, const PictureKey&, float exposure = 1);

}  // namespace svnet
