#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "base/exif_orientation.h"
#include "image/image.h"

namespace svnet::io {

/// Reads a PNG, JPEG or WebP image as RGB, with the pixels of Pillow's Image.open(path).convert("RGB"): grey becomes
/// three equal channels, a palette its colours, CMYK and YCCK (JPEG) are converted without a colour profile, and
/// transparency is dropped without blending. A 16-bit PNG keeps the upper byte of each level (Pillow clips 16-bit grey
/// instead). EXIF orientation is ignored, unless `exif` says to obey it.
///
/// `path` may be a pipe. The contents tell the format, not the name. Throws Error that names `path` for a file that
/// cannot be read, has another format, has more than 64 megapixels (checked before decoding), is truncated or damaged,
/// or is an animated WebP. Writes nothing to stderr. Thread-safe.
Image read_image(const std::filesystem::path& path, ExifOrientation exif = ExifOrientation::ignore);

/// An image as it is stored, and its EXIF orientation, 1 to 8; 1 if it has none.
struct StoredImage {
  Image image;
  int exif_orientation = 1;
};

/// Reads a file once, for both. Throws Error as read_image does.
StoredImage read_stored_image(const std::filesystem::path& path);

/// The same for the contents of a file in memory. Errors call it `name`.
StoredImage decode_stored_image(const std::string& name, std::span<const std::uint8_t> file);

/// The EXIF orientation of a file, 1 to 8, without decoding it; 1 if it has none, or cannot be read.
int read_exif_orientation(const std::filesystem::path& path);

/// The contents of a baseline JPEG file of the image. `quality`: 1 to 100. Requires an image with pixels.
std::string encoded_jpeg(const Image& image, int quality);

/// Writes an 8-bit RGB PNG atomically (io/files/atomic_file.h). Throws Error that names `path`.
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace svnet::io
