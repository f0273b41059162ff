#pragma once
#include <cstddef>
#include <cstdint>

#include "image/image.h"
#include "svnet/svnet.h"

namespace svnet {

/// Copies pixels in the layout of svnet_embed to an RGB image. Throws Error for an impossible size, stride or format.
Image image_of(const std::uint8_t* pixels, std::int32_t height, std::int32_t width, std::size_t stride_bytes,
               svnet_pixel_format format);

}  // namespace svnet
