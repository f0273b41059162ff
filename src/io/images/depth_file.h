#pragma once
#include <cstdint>
#include <filesystem>
#include <span>

#include "image/depth_image.h"

namespace svnet {

/// A depth picture: a 16-bit grey PNG in millimetres, or a NumPy file (.npy) of a two-dimensional array of 32-bit or
/// 64-bit floats in metres. The kind is told by the contents. A hole is what is no positive number below 100 m, and a
/// PNG's largest level, 65535. Throws Error, one line that names `path`, for anything else, and where there are only
/// holes.
DepthImage read_depth(const std::filesystem::path& path);

/// A 16-bit PNG in millimetres; distances above 65.534 m become holes. Throws Error that names `path`.
void write_depth_png(const std::filesystem::path& path, const DepthImage&);

/// An 8-bit grey PNG. Throws Error that names `path`.
void write_grey_png(const std::filesystem::path& path, Index height, Index width, std::span<const std::uint8_t> levels);

}  // namespace svnet
