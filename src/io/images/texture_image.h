#pragma once
#include <string>

#include "io/images/image_codecs.h"

namespace svnet::io {

/// An image as tools for meshes write textures: PNG, JPEG, WebP, BMP, TGA, TIFF or GIF (its first image) as RGB;
/// transparency is dropped. `file` is the whole file, `name` begins messages. The kind is told by the contents, but a
/// TGA, which need not be marked, also by its name. Throws Error for a file of no known kind, that is damaged, or
/// larger than 64 megapixels. Safe to call from several threads.
Image decode_texture(const std::string& name, Bytes file);

}  // namespace svnet::io
