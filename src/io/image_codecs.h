#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "models/image/image.h"

// The codecs behind io/image_file.h. Each takes the whole file and throws Error for what it cannot decode completely;
// `name` begins the message.
namespace svnet {

using Bytes = std::span<const std::uint8_t>;

Image decode_jpeg(const std::string& name, Bytes file);
Image decode_png(const std::string& name, Bytes file);
Image decode_webp(const std::string& name, Bytes file);

/// The contents of a PNG file.
std::string encoded_png(const std::string& name, const Image& image);

/// An image with room for its pixels. Throws Error above 64 megapixels.
Image image_of_size(const std::string& name, Index height, Index width);

/// The Error of a file that the codec gave up on, with its reason.
[[noreturn]] void fail_damaged(const std::string& name, const char* kind, const std::string& reason);

}  // namespace svnet
