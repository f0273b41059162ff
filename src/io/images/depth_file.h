#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "image/depth_image.h"

namespace svnet::io {

/// Reads a depth image: a 16-bit grey PNG, or a NumPy file (.npy) with an array (height, width), with or without
/// further axes of length 1, in either order and byte order, of floats of 16, 32 or 64 bits or integers of 16, 32
/// or 64. The contents tell the format, not the name. `unit_m`: metres per unit (image/depth_unit.h); without it
/// integers are millimetres and floats metres. Depth <= 0, NaN, >= 100 m and the 16-bit level 65535 mean: not measured;
/// these pixels become 0. Throws Error that names `path` for any other file, and if no pixel was measured.
DepthImage read_depth(const std::filesystem::path& path, std::optional<double> unit_m = {});

/// The same for the contents of a file in memory. Errors call it `name`.
DepthImage decode_depth(const std::string& name, std::span<const std::uint8_t> file, std::optional<double> unit_m = {});

/// The contents of a 16-bit grey PNG file in millimetres. Depth above 65.534 m becomes 0, not measured. Throws Error
/// that begins with `name`.
std::string encoded_depth_png(const std::string& name, const DepthImage&);
/// Writes it atomically. Throws Error that names `path`.
void write_depth_png(const std::filesystem::path& path, const DepthImage&);

}  // namespace svnet::io
