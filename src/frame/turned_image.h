#pragma once
#include "image/image.h"

// A top view turned into the frame of a candidate camera. Only the image's centred square is kept; outside its
// inscribed circle every pixel has one colour, the mean of the circle's rim (radius .89 to .99), so that the frame of
// the image does not show how far it was turned.
namespace svnet::frame {

/// The centred square of the image, turned about its middle by (90 - theta_deg) degrees counter-clockwise: the camera
/// at azimuth theta_deg stands at its lower edge (docs/camera-convention.md). Its side is the image's shorter one.
/// Angles that differ by quarter turns give images that are exact quarter turns of each other, and 90 changes no
/// pixel of the circle. Other angles are interpolated by Keys' cubic convolution (a = -1/2; "Cubic convolution
/// interpolation for digital image processing", 1981), with pixels beyond the border repeated. Throws Error for an
/// empty image, for one without height x width x 3 values, and unless theta_deg is finite.
Image turned_image(const Image& top_image, double theta_deg);

/// The centred square of the image, turned counter-clockwise by `quarters` quarter turns, 0 to 3. Throws Error as
/// turned_image does for the image.
Image quarter_turned_square(const Image& image, int quarters);

/// The image with left and right exchanged: what the same camera would see of the mirror image of the object.
Image mirrored(const Image&);

}  // namespace svnet::frame
