#include "image/resize.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"

namespace svnet {
namespace {

constexpr Index kChannels = 3;

/// The source index of each target index. Positions are summed step by step as Pillow does, so that ties are rounded
/// the same way.
void nearest_sources(Index from, Index to, std::vector<Index>& sources) {
  sources.resize(static_cast<std::size_t>(to));
  const double step = static_cast<double>(from) / static_cast<double>(to);
  double position = step * 0.5;
  for (Index& source : sources) {
    source = std::min(static_cast<Index>(position), from - 1);
    position += step;
  }
}

void set_size(Image& image, Index height, Index width) {
  image.height = height;
  image.width = width;
  image.rgb.resize(static_cast<std::size_t>(height * width * kChannels));
}

const Image& resized_nearest(const Image& image, Index height, Index width, ResizeBuffers& buffers) {
  nearest_sources(image.height, height, buffers.rows);
  nearest_sources(image.width, width, buffers.columns);
  set_size(buffers.result, height, width);
  std::uint8_t* out = buffers.result.rgb.data();
  for (const Index row : buffers.rows) {
    const std::uint8_t* in = image.rgb.data() + row * image.width * kChannels;
    for (const Index column : buffers.columns) out = std::copy_n(in + column * kChannels, kChannels, out);
  }
  return buffers.result;
}

/// The triangle filter: Pillow's precompute_coeffs and normalize_coeffs_8bpc, operation by operation.
const ResizeFilter& triangle_filter(Index from, Index to, ResizeBuffers& buffers) {
  const double scale = static_cast<double>(from) / static_cast<double>(to);
  const double support = std::max(scale, 1.0);
  ResizeFilter& filter = buffers.filter;
  filter.taps = static_cast<Index>(std::ceil(support)) * 2 + 1;
  filter.starts.clear();
  filter.counts.clear();
  filter.weights.assign(static_cast<std::size_t>(to * filter.taps), 0);
  buffers.taps.assign(static_cast<std::size_t>(filter.taps), 0.0);
  std::vector<double>& taps = buffers.taps;
  // NOLINTBEGIN(bugprone-incorrect-roundings): as Pillow rounds, bit for bit
  for (Index i = 0; i < to; ++i) {
    const double centre = (static_cast<double>(i) + 0.5) * scale;
    const Index start = std::max<Index>(static_cast<Index>(centre - support + 0.5), 0);
    const Index count = std::min(static_cast<Index>(centre + support + 0.5), from) - start;
    double sum = 0;
    for (Index t = 0; t < count; ++t) {
      const double distance = std::abs((static_cast<double>(t + start) - centre + 0.5) * (1.0 / support));
      taps[t] = distance < 1 ? 1 - distance : 0;
      sum += taps[t];
    }
    for (Index t = 0; t < count; ++t) {
      const double weight = sum != 0 ? taps[t] / sum : taps[t];
      filter.weights[i * filter.taps + t] = static_cast<std::int32_t>(0.5 + weight * (1 << kFilterBits));
    }
    filter.starts.push_back(start);
    filter.counts.push_back(count);
  }
  // NOLINTEND(bugprone-incorrect-roundings)
  return filter;
}

void set_width(const Image& image, Index width, ResizeBuffers& buffers, Image& result) {
  const ResizeFilter& filter = triangle_filter(image.width, width, buffers);
  set_size(result, image.height, width);
  filter_width(filter, image.rgb.data(), image.height, image.width, width, result.rgb.data(), buffers.width);
}

void set_height(const Image& image, Index height, ResizeBuffers& buffers, Image& result) {
  const ResizeFilter& filter = triangle_filter(image.height, height, buffers);
  set_size(result, height, image.width);
  filter_height(filter, image.rgb.data(), image.width * kChannels, height, result.rgb.data());
}

}  // namespace

Interpolation interpolation_named(std::string_view name) {
  if (const auto interpolation = find_enum<Interpolation>(std::string(name))) return *interpolation;
  fail("interpolation '", name, "' is not known", suggestion(name, names_of<Interpolation>()));
}

Image resized(const Image& image, Index height, Index width, Interpolation interpolation) {
  ResizeBuffers buffers;
  if (&resized(image, height, width, interpolation, buffers) == &image) return image;
  return std::move(buffers.result);
}

const Image& resized(const Image& image, Index height, Index width, Interpolation interpolation,
                     ResizeBuffers& buffers) {
  check(image.height > 0 && image.width > 0 && height > 0 && width > 0, "[resize] cannot make a ", height, "x", width,
        " image of a ", image.height, "x", image.width, " image: every side must be at least 1");
  check(static_cast<Index>(image.rgb.size()) == image.height * image.width * kChannels, "[resize] a ", image.height,
        "x", image.width, "x3 image has ", image.rgb.size(), " values, expected ",
        image.height * image.width * kChannels);
  if (interpolation == Interpolation::nearest) return resized_nearest(image, height, width, buffers);
  // A side that keeps its length needs no filter, which would not change a pixel.
  if (image.width == width && image.height == height) return image;
  if (image.width == width) {
    set_height(image, height, buffers, buffers.result);
  } else if (image.height == height) {
    set_width(image, width, buffers, buffers.result);
  } else {
    set_width(image, width, buffers, buffers.between);
    set_height(buffers.between, height, buffers, buffers.result);
  }
  return buffers.result;
}

}  // namespace svnet
