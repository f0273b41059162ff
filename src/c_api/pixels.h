#pragma once
#include <cstddef>
#include <cstdint>

#include "image/depth_image.h"
#include "image/image.h"
#include "svnet/svnet.h"

namespace svnet {

/// Copies pixels in the layout of svnet_embed to an RGB image. Throws Error for an impossible size, stride or format;
/// its message begins with the function. Allocates nothing if the image was as large before.
void read_pixels(const char* function, const std::uint8_t* pixels, std::int32_t height, std::int32_t width,
                 std::size_t stride_bytes, svnet_pixel_format format, Image& image);

/// Copies depth in metres, (height, width) without gaps. What is not a positive number becomes 0, not measured.
void read_depth(const float* metres, Index height, Index width, DepthImage& depth);

}  // namespace svnet
