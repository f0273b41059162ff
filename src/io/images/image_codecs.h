#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "image/depth_image.h"
#include "image/image.h"

// The image formats, and what they share. A decoder takes the contents of a whole file and throws Error unless it can
// decode all of them. `name` begins the message of every Error. io/images/image_file.h chooses the decoder.
namespace svnet::io {

using Bytes = std::span<const std::uint8_t>;

/// The format of a file by its first bytes.
enum class ImageFormat { jpeg, png, webp, other };
ImageFormat image_format(Bytes file);

/// Decodes a JPEG, PNG or WebP file. Empty for any other format.
std::optional<Image> decode_image(const std::string& name, Bytes file);
Image decode_jpeg(const std::string& name, Bytes file);
Image decode_png(const std::string& name, Bytes file);
Image decode_webp(const std::string& name, Bytes file);
/// What a file of another format is, if it is recognised, for messages: see io/files/file_format.h.
std::string recognised_instead(Bytes file);

/// The EXIF orientation of a JPEG, PNG or WebP file, 1 to 8; 1 if it has none.
int exif_orientation(Bytes file);

/// What a PNG file shows, which decides how it is compressed: areas that repeat, or the noise of a camera.
enum class PngContent { drawing, photograph };
/// The contents of a PNG file with 8-bit RGB pixels.
std::string encoded_png(const std::string& name, const Image& image, PngContent content = PngContent::drawing);

/// An image with one 16-bit channel, (height, width).
struct Grey16 {
  Index height = 0;
  Index width = 0;
  std::vector<std::uint16_t> levels;
};

/// Throws Error for any other kind of PNG.
Grey16 decode_grey16_png(const std::string& name, Bytes file);
/// For pixels with noise, such as depth.
std::string encoded_grey16_png(const std::string& name, const Grey16&);
/// `levels`: one 8-bit channel, (height, width), of areas of one level, as masks are.
std::string encoded_grey_png(const std::string& name, Index height, Index width, std::span<const std::uint8_t> levels);

/// Whether a file begins as NumPy's .npy files do.
bool is_npy(Bytes file);
/// Depth from a .npy file: see read_depth.
DepthImage decode_npy_depth(const std::string& name, Bytes file, std::optional<double> unit_m);
/// No scene of a robot is as deep; larger values are in another unit.
constexpr double kFarthest_m = 100;
/// The depth, or 0 if `z_m` means that the pixel was not measured.
float depth_or_zero(double z_m);

/// The bytes of a file, or all that comes from a pipe. Throws Error that names it if it cannot be read, is empty, or is
/// larger than 1 GiB.
std::vector<std::uint8_t> image_contents(const std::filesystem::path& path);
/// Whether the bytes `expected` are at `offset`.
bool has_bytes(Bytes file, std::size_t offset, std::string_view expected);

/// Throws Error unless the image has at least one pixel and at most kMostPixels.
void check_image_size(const std::string& name, Index height, Index width);
/// A black image. Throws Error as check_image_size does.
Image image_of_size(const std::string& name, Index height, Index width);

/// Throws the Error of a file that a codec could not decode, with the codec's `reason`; std::bad_alloc if that is a
/// lack of memory.
[[noreturn]] void fail_damaged(const std::string& name, const char* kind, const std::string& reason);

}  // namespace svnet::io
