#pragma once
#include <filesystem>

#include "image/image.h"

namespace svnet {

/// Reads a PNG, JPEG or WebP image as RGB, with the pixels of Pillow's Image.open(path).convert("RGB"): grey becomes
/// three equal channels, a palette its colours, and transparency is dropped without blending. A 16-bit PNG keeps the
/// upper byte of each level (Pillow clips 16-bit grey instead). EXIF orientation is ignored.
///
/// The contents tell the format, not the name. Throws Error that names `path` for a file that cannot be read, has
/// another format, has more than 64 megapixels (checked before decoding), is truncated or damaged, or is an animated
/// WebP or a CMYK JPEG. Writes nothing to stderr. Thread-safe.
Image read_image(const std::filesystem::path& path);

/// Writes an 8-bit RGB PNG atomically (io/files/atomic_file.h). Throws Error that names `path`.
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace svnet
