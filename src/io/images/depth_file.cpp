#include "io/images/depth_file.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string>

#include "base/error.h"
#include "io/files/atomic_file.h"
#include "io/images/image_codecs.h"

namespace svnet {
namespace {

namespace fs = std::filesystem;

/// No scene of a robot is as deep; larger values are in another unit than metres.
constexpr float kFarthest_m = 100;
/// Cameras write this PNG level, or 0, for pixels that were not measured.
constexpr std::uint16_t kNotMeasured = 65535;

/// Throws Error unless at least one pixel was measured.
const DepthImage& checked(const std::string& name, const DepthImage& image) {
  const auto is_distance = [](float z) { return z > 0; };
  check(std::any_of(image.metres.begin(), image.metres.end(), is_distance), name, ": holds no distance between 0 and ",
        kFarthest_m, " m; depth is in millimetres in a PNG, in metres in .npy");
  return image;
}

/// The depth, or 0 if `z` means that the pixel was not measured.
float depth_or_zero(double z) { return z > 0 && z < static_cast<double>(kFarthest_m) ? static_cast<float>(z) : 0.0f; }

/// Format: "\x93NUMPY", version, length of the header, a Python dictionary, then the array.
/// https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
DepthImage decode_npy(const std::string& name, Bytes file) {
  const auto damaged = [&](const char* what) {
    fail(name, ": is a damaged NumPy file (", what, "); replace the file");
  };
  if (file.size() < 12) damaged("it ends within its header");
  const std::size_t prefix = file[6] == 1 ? 10 : 12;
  std::size_t length = file[8] | file[9] << 8;
  if (prefix == 12) length |= static_cast<std::size_t>(file[10]) << 16 | static_cast<std::size_t>(file[11]) << 24;
  if (length > file.size() - prefix) damaged("it ends within its header");
  const std::string header(reinterpret_cast<const char*>(file.data()) + prefix, length);
  const bool is_double = header.find("'<f8'") != std::string::npos;
  check(is_double || header.find("'<f4'") != std::string::npos, name,
        ": holds no little-endian floats of 32 or 64 bits, expected depth in metres");
  check(header.find("'fortran_order': False") != std::string::npos, name,
        ": is stored by columns; save it with numpy.ascontiguousarray");
  const char* at = header.c_str() + std::min(header.find("'shape': ("), header.size());
  const char* end = header.c_str() + header.size();
  DepthImage image;
  bool two = end - at > 10;
  if (two) {
    const auto rows = std::from_chars(at + 10, end, image.height);
    two = rows.ec == std::errc() && end - rows.ptr > 2 && rows.ptr[0] == ',' && rows.ptr[1] == ' ';
    if (two) {
      const auto columns = std::from_chars(rows.ptr + 2, end, image.width);
      two = columns.ec == std::errc() && columns.ptr != end && *columns.ptr == ')';
    }
  }
  check(two, name, ": holds an array that is not two-dimensional, expected (height, width)");
  check_image_size(name, image.height, image.width);
  const auto count = static_cast<std::size_t>(image.height * image.width),
             width = is_double ? sizeof(double) : sizeof(float);
  if (file.size() - prefix - length != count * width) damaged("its size is not that of its array");
  image.metres.resize(count);
  const std::uint8_t* data = file.data() + prefix + length;
  for (std::size_t i = 0; i < count; ++i) {
    double z = 0;
    float single = 0;
    if (is_double)
      std::memcpy(&z, data + i * width, width);
    else
      std::memcpy(&single, data + i * width, width), z = static_cast<double>(single);
    image.metres[i] = depth_or_zero(z);
  }
  return image;
}

static_assert(std::endian::native == std::endian::little);

}  // namespace

DepthImage read_depth(const fs::path& path) {
  const std::vector<std::uint8_t> file = picture_contents(path);
  const std::string name = path.string();
  if (has_bytes(file, 0, "\x93NUMPY")) return checked(name, decode_npy(name, file));
  check(has_bytes(file, 0, "\x89PNG\r\n\x1a\n"), name,
        ": is neither a PNG nor a NumPy file, expected depth as 16-bit PNG in millimetres or .npy in metres");
  const Grey16 grey = decode_grey16_png(name, file);
  DepthImage image{grey.height, grey.width, {}};
  image.metres.reserve(grey.levels.size());
  for (const std::uint16_t level : grey.levels)
    image.metres.push_back(level == kNotMeasured ? 0.0f : static_cast<float>(level) / 1000);
  return checked(name, image);
}

void write_depth_png(const fs::path& path, const DepthImage& depth) {
  Grey16 grey{depth.height, depth.width, {}};
  grey.levels.reserve(depth.metres.size());
  for (const float z : depth.metres) {
    const double mm = std::round(1000.0 * static_cast<double>(z));
    grey.levels.push_back(mm >= 0 && mm < kNotMeasured ? static_cast<std::uint16_t>(mm) : std::uint16_t{0});
  }
  write_atomically(path, encoded_grey16_png(path.string(), grey));
}

void write_grey_png(const fs::path& path, Index height, Index width, std::span<const std::uint8_t> levels) {
  write_atomically(path, encoded_grey_png(path.string(), height, width, levels));
}

}  // namespace svnet
