#pragma once
#include <string_view>

#include "base/enum_names.h"
#include "image/image.h"

namespace svnet {

/// nearest takes the source pixel under the centre of each target pixel. bilinear is a triangle filter that widens with
/// the reduction (antialiased), along rows, then along columns, in 8-bit fixed point. Both give the bits of Pillow's
/// Image.resize, which Keras' image loading uses; only where the height shrinks much more than the width, Pillow 13
/// filters columns first, and bilinear differs from it by one grey level.
enum class Interpolation { nearest, bilinear };

template <>
inline constexpr auto enum_names<Interpolation> = std::to_array<EnumName<Interpolation>>(
    {{Interpolation::nearest, "nearest"}, {Interpolation::bilinear, "bilinear"}});

/// Throws Error for an unknown name.
Interpolation interpolation_named(std::string_view name);

/// `image` at another size. Throws Error unless both images have at least one pixel and rgb has the size it should.
Image resized(const Image& image, Index height, Index width, Interpolation);

}  // namespace svnet
