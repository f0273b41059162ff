#pragma once
#include <cstdint>
#include <filesystem>
#include <span>

#include "image/depth_image.h"

namespace svnet {

/// Reads a depth image: a 16-bit grey PNG in millimetres, or a NumPy file (.npy) with a two-dimensional array of 32-bit
/// or 64-bit floats in metres. The contents tell the format, not the name. Depth <= 0, NaN, >= 100 m and PNG level
/// 65535 mean: not measured; these pixels become 0. Throws Error that names `path` for any other file, and if no pixel
/// was measured.
DepthImage read_depth(const std::filesystem::path& path);

/// Writes a 16-bit grey PNG in millimetres. Depth above 65.534 m becomes 0, not measured. Throws Error that names
/// `path`.
void write_depth_png(const std::filesystem::path& path, const DepthImage&);

/// Writes an 8-bit grey PNG; levels (height, width). Throws Error that names `path`.
void write_grey_png(const std::filesystem::path& path, Index height, Index width, std::span<const std::uint8_t> levels);

}  // namespace svnet
