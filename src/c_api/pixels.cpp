#include "pixels.h"

#include <array>
#include <cmath>

#include "base/error.h"

namespace svnet {
namespace {

struct Layout {
  std::size_t bytes;                  // of a pixel
  std::array<std::size_t, 3> offset;  // of red, green, blue
};

Layout layout_of(const char* function, svnet_pixel_format format) {
  switch (static_cast<int>(format)) {
    case SVNET_RGB8:
      return {3, {0, 1, 2}};
    case SVNET_BGR8:
      return {3, {2, 1, 0}};
    case SVNET_RGBA8:
      return {4, {0, 1, 2}};
    case SVNET_BGRA8:
      return {4, {2, 1, 0}};
    case SVNET_GRAY8:
      return {1, {0, 0, 0}};
    default:
      fail("[", function, "] there is no pixel format ", static_cast<int>(format));
  }
}

}  // namespace

void read_pixels(const char* function, const std::uint8_t* pixels, std::int32_t height, std::int32_t width,
                 std::size_t stride_bytes, svnet_pixel_format format, Image& image) {
  const Layout layout = layout_of(function, format);
  check(height > 0 && width > 0, "[", function, "] the image is ", height, "x", width, ", expected at least one pixel");
  check(Index{height} * width <= kMostPixels, "[", function, "] the image is ", height, "x", width,
        ", larger than 64 megapixels");
  const std::size_t row_bytes = static_cast<std::size_t>(width) * layout.bytes;
  check(stride_bytes >= row_bytes, "[", function, "] stride_bytes is ", stride_bytes, ", less than the ", row_bytes,
        " bytes of a row");
  image.height = height;
  image.width = width;
  image.rgb.resize(static_cast<std::size_t>(Index{height} * width * 3));
  std::uint8_t* out = image.rgb.data();
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
    const std::uint8_t* in = pixels + y * stride_bytes;
    for (std::int32_t x = 0; x < width; ++x, in += layout.bytes)
      for (const std::size_t offset : layout.offset) *out++ = in[offset];
  }
}

void read_depth(const float* metres, Index height, Index width, DepthImage& depth) {
  depth.height = height;
  depth.width = width;
  depth.metres.assign(metres, metres + height * width);
  for (float& value : depth.metres)
    if (!std::isfinite(value) || value < 0) value = 0;
}

}  // namespace svnet
