#pragma once
#include "base/random.h"
#include "image/image.h"

namespace svnet {

/// How far a picture is changed at random, so that a network learns what stays. 0 everywhere: not at all.
struct Augmentation {
  double zoom = 0.25;       ///< the object appears larger or smaller by a factor of up to 1 + this
  double shift = 0.08;      ///< of the picture's sides, either way
  double turn_deg = 15;     ///< about the picture's centre, either way
  double flip = 0.5;        ///< probability of changing left and right
  double brightness = 0.3;  ///< all grey levels by a factor of up to 1 + this
  double contrast = 0.4;    ///< distances from mid-grey by a factor of up to 1 + this
  double colour = 0.4;      ///< each channel by a factor of up to 1 + this: tables are many, those of a collection few
  double noise = 6;         ///< grey levels, either way
};

/// `image` changed as the stream says; pixels from outside are those of its border.
Image augmented(const Image& image, const Augmentation& how, RandomStream& random);

}  // namespace svnet
