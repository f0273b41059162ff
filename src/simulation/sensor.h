#pragma once
#include "simulation/scene.h"

namespace svnet::simulation {

/// An image of an RGB-D camera.
struct RgbdImage {
  Image rgb;
  DepthImage depth;
};

/// The image that the paper's kind of RGB-D camera takes of a shot. Colours are blurred by the lens (Gaussian, σ =
/// 0.5 pixels), get shot noise and become 8-bit sRGB; `exposure` multiplies the light. Depth z gets Gaussian noise of
/// σ = 1.4 mm · z² (z in metres) and is rounded to millimetres; many pixels along silhouettes are not measured.
RgbdImage sensor_image(const Shot&, const ImageKey&, float exposure = 1);

}  // namespace svnet::simulation
