#pragma once
#include "base/random.h"
#include "image/image.h"

namespace svnet::train {

/// The size of random changes of an image. A network learns to ignore such changes. 0: no change.
struct Augmentation {
  double zoom = 0.25;       ///< the object becomes larger or smaller by a factor of up to 1 + this
  double shift = 0.08;      ///< as a fraction of the image's sides, in all directions
  double turn_deg = 15;     ///< about the image's centre, in both directions
  double flip = 0.5;        ///< probability of changing left and right
  double brightness = 0.3;  ///< all grey levels by a factor of up to 1 + this
  double contrast = 0.4;    ///< distances from mid-grey by a factor of up to 1 + this
  double colour = 0.4;      ///< each channel by a factor of up to 1 + this
  double noise = 6;         ///< grey levels, up or down
};

/// The image with random changes from the stream. Pixels outside of the image repeat its border.
Image augmented(const Image& image, const Augmentation& how, RandomStream& random);

}  // namespace svnet::train
