#pragma once
#include <cstddef>
#include <cstdint>

#include "image/image.h"
#include "svnet/svnet.h"

namespace svnet {

/// A copy as RGB of pixels laid out as svnet_embed takes them. Throws Error for sizes, strides and formats that are not
/// possible.
Image image_of(const std::uint8_t* pixels, std::int32_t height, std::int32_t width, std::size_t stride_bytes,
               svnet_pixel_format format);

}  // namespace svnet
