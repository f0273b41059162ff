#pragma once
#include "image/image.h"

namespace svnet {

/// The image as viewers show it: `orientation` is the value of the EXIF tag 0x0112, 1 to 8, where 1 changes nothing
/// and 6 means a quarter turn clockwise. Gives the pixels of Pillow's ImageOps.exif_transpose.
Image oriented(Image image, int orientation);

}  // namespace svnet
