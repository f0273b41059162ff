#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "image/image.h"

// The codecs behind io/image_file.h. Each takes the whole file and throws Error for what it cannot decode completely;
// `name` begins the message.
namespace svnet {

using Bytes = std::span<const std::uint8_t>;

Image decode_jpeg(const std::string& name, Bytes file);
Image decode_png(const std::string& name, Bytes file);
Image decode_webp(const std::string& name, Bytes file);

/// The contents of a PNG file.
std::string encoded_png(const std::string& name, const Image& image);

/// A picture of one 16-bit channel, (height, width).
struct Grey16 {
  Index height = 0;
  Index width = 0;
  std::vector<std::uint16_t> levels;
};

/// Throws Error for PNG pictures of any other kind.
Grey16 decode_grey16_png(const std::string& name, Bytes file);
std::string encoded_grey16_png(const std::string& name, const Grey16&);
/// One 8-bit channel.
std::string encoded_grey_png(const std::string& name, Index height, Index width, std::span<const std::uint8_t> levels);

/// The whole file. Throws Error that names it where it cannot be read, is empty, or larger than a picture can be.
std::vector<std::uint8_t> picture_contents(const std::filesystem::path& path);
/// Whether `expected` is at `offset`.
bool has_bytes(Bytes file, std::size_t offset, std::string_view expected);

/// Throws Error for a picture without pixels, or with more than 64 megapixels.
void check_image_size(const std::string& name, Index height, Index width);
/// An image with room for its pixels. Throws Error as check_image_size does.
Image image_of_size(const std::string& name, Index height, Index width);

/// The Error of a file that the codec gave up on, with its reason.
[[noreturn]] void fail_damaged(const std::string& name, const char* kind, const std::string& reason);

}  // namespace svnet
