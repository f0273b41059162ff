#include "io/images/depth_file.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "io/files/atomic_file.h"
#include "io/images/image_codecs.h"

namespace svnet::io {
namespace {

namespace fs = std::filesystem;

/// Cameras write this PNG level, or 0, for pixels that were not measured.
constexpr std::uint16_t kNotMeasured = 65535;

/// Throws Error unless at least one pixel was measured.
const DepthImage& checked(const std::string& name, const DepthImage& image) {
  const auto is_distance = [](float z) { return z > 0; };
  check(std::any_of(image.metres.begin(), image.metres.end(), is_distance), name, ": holds no distance between 0 and ",
        kFarthest_m, " m; integers are taken as millimetres and floats as metres, unless --depth-unit says otherwise");
  return image;
}

}  // namespace

float depth_or_zero(double z_m) { return z_m > 0 && z_m < kFarthest_m ? static_cast<float>(z_m) : 0.0f; }

DepthImage read_depth(const fs::path& path, std::optional<double> unit_m) {
  return decode_depth(path.string(), image_contents(path), unit_m);
}

DepthImage decode_depth(const std::string& name, Bytes file, std::optional<double> unit_m) {
  if (is_npy(file)) return checked(name, decode_npy_depth(name, file, unit_m));
  check(!has_bytes(file, 0, "PK\3\4"), name, ": is a ZIP archive (.npz?), expected one array, by numpy.save");
  if (image_format(file) != ImageFormat::png) {
    const std::string instead = recognised_instead(file);
    fail(name, ": is neither a PNG nor a NumPy file", instead, instead.empty() ? ", " : "; ",
         "expected depth as 16-bit PNG in millimetres or .npy in metres");
  }
  const Grey16 grey = decode_grey16_png(name, file);
  DepthImage image{grey.height, grey.width, {}};
  image.metres.reserve(grey.levels.size());
  const double scale = image.unit_m = unit_m.value_or(0.001);
  for (const std::uint16_t level : grey.levels)
    image.metres.push_back(level == kNotMeasured ? 0.0f : depth_or_zero(scale * level));
  return checked(name, image);
}

std::string encoded_depth_png(const std::string& name, const DepthImage& depth) {
  Grey16 grey{depth.height, depth.width, {}};
  grey.levels.reserve(depth.metres.size());
  for (const float z : depth.metres) {
    const double mm = std::round(1000.0 * static_cast<double>(z));
    grey.levels.push_back(mm >= 0 && mm < kNotMeasured ? static_cast<std::uint16_t>(mm) : std::uint16_t{0});
  }
  return encoded_grey16_png(name, grey);
}

void write_depth_png(const fs::path& path, const DepthImage& depth) {
  write_atomically(path, encoded_depth_png(path.string(), depth));
}

}  // namespace svnet::io
