#pragma once
#include <filesystem>

#include "image/image.h"

namespace svnet {

/// A PNG, JPEG or WebP picture as RGB, with the pixels that Pillow's Image.open(path).convert("RGB") gives: grey levels
/// are repeated, palettes looked up, transparency is dropped (not blended with a background), 16-bit PNG keeps its
/// upper byte (where Pillow clips grey ones), orientation tags are ignored.
///
/// The kind is told by the contents, not by the name. Throws Error, one line that names `path`, for a file that cannot
/// be read, is of no known kind, is larger than 64 megapixels (before anything is decoded), cut short or damaged, an
/// animated WebP or a CMYK JPEG. Writes nothing to stderr. Safe to call from several threads.
Image read_image(const std::filesystem::path& path);

/// Writes an 8-bit RGB PNG atomically (io/atomic_file.h). Throws Error that names `path`.
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace svnet
