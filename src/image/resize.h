#pragma once
#include <string>
#include <string_view>

#include "image/image.h"

namespace svnet {

/// nearest: the source pixel under the centre of each target pixel. bilinear: an antialiased triangle filter, along
/// rows, then along columns, in 8-bit fixed point. Both give the bits of Pillow's Image.resize, which Keras uses to
/// load images. One exception: if the height shrinks much more than the width, Pillow 13 filters columns first, and
/// bilinear differs by at most one level.
enum class Interpolation { nearest, bilinear };

/// The names in files: "nearest", "bilinear". interpolation_named throws Error for any other name.
std::string name_of(Interpolation);
Interpolation interpolation_named(std::string_view name);

/// `image` resized. Throws Error unless both sizes are positive and rgb has height x width x 3 elements.
Image resized(const Image& image, Index height, Index width, Interpolation);

}  // namespace svnet
