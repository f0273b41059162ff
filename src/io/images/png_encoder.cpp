#include <bit>
#include <csetjmp>
#include <new>
#include <span>
#include <string>
#include <utility>

#include <png.h>
#include <zlib.h>

#include "base/error.h"
#include "io/images/image_codecs.h"
#include "io/images/png_errors.h"

namespace svnet::io {
namespace {

static_assert(std::endian::native == std::endian::little);  // the levels of a PNG are big-endian: png_set_swap

/// How noisy pixels are encoded: one filter for all rows, and no search for repeated strings, of which noise has none.
/// Measured on rendered views, against libpng's own choice for speed: less than half of the time, and 0.76 (RGB), 0.97
/// (depth) and 0.5 (masks) of the size. docs/performance-notes.md has the table.
struct NoisyFormat {
  int colour_type, bits, filter;
  std::size_t row_bytes;
};

/// libpng with errors that return here (PngErrors).
class PngEncoder {
 public:
  PngEncoder() {
    png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, &errors_, PngErrors::return_from, PngErrors::ignore);
    info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
    if (info_ == nullptr) png_destroy_write_struct(&png_, nullptr);
    check(info_ != nullptr, "libpng cannot be used: not enough memory, or another version than at compile time");
  }
  ~PngEncoder() { png_destroy_write_struct(&png_, &info_); }
  PngEncoder(const PngEncoder&) = delete;
  PngEncoder& operator=(const PngEncoder&) = delete;

  /// Writes rows of format.row_bytes each.
  bool write(Index height, Index width, const NoisyFormat& format, const std::uint8_t* rows) {
    if (setjmp(errors_.back) != 0) return false;
    png_set_write_fn(
        png_, this,
        [](png_structp png, png_bytep bytes, std::size_t size) {
          auto* encoder = static_cast<PngEncoder*>(png_get_io_ptr(png));
          if (!encoder->append(bytes, size)) png_error(png, "not enough memory");
        },
        [](png_structp) {});
    png_set_IHDR(png_, info_, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), format.bits,
                 format.colour_type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (format.bits == 8) png_set_sRGB(png_, info_, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_filter(png_, PNG_FILTER_TYPE_BASE, format.filter);
    png_set_compression_level(png_, 1);
    png_set_compression_strategy(png_, Z_RLE);
    png_set_compression_buffer_size(png_, std::size_t{1} << 16);
    png_write_info(png_, info_);
    if (format.bits == 16) png_set_swap(png_);
    for (Index row = 0; row < height; ++row)
      png_write_row(png_, rows + static_cast<std::size_t>(row) * format.row_bytes);
    png_write_end(png_, info_);
    return true;
  }

  std::string take() { return std::move(file_); }
  const char* reason() const { return errors_.message; }

 private:
  /// Whether there was memory for them. Exceptions must not pass through libpng.
  bool append(const std::uint8_t* bytes, std::size_t size) noexcept {
    try {
      file_.append(reinterpret_cast<const char*>(bytes), size);
      return true;
    } catch (const std::bad_alloc&) {
      return false;
    }
  }

  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::string file_;
  PngErrors errors_{};
};

std::string encoded_noise(const std::string& name, Index height, Index width, const NoisyFormat& format,
                          const void* pixels) {
  PngEncoder encoder;
  check(encoder.write(height, width, format, static_cast<const std::uint8_t*>(pixels)), name,
        ": cannot be written: ", encoder.reason());
  return encoder.take();
}

/// Encodes `pixels`, which are in `format`, one of the formats of libpng's simplified API.
std::string encoded(const std::string& name, Index height, Index width, png_uint_32 format, const void* pixels) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.format = format;
  png.height = static_cast<png_uint_32>(height);
  png.width = static_cast<png_uint_32>(width);
  png.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string file(size, '\0');
  check(png_image_write_to_memory(&png, file.data(), &size, 0, pixels, 0, nullptr) != 0, name,
        ": cannot be written: ", png.message);
  file.resize(size);
  return file;
}

}  // namespace

std::string encoded_grey16_png(const std::string& name, const Grey16& image) {
  return encoded_noise(name, image.height, image.width,
                       {PNG_COLOR_TYPE_GRAY, 16, PNG_FILTER_SUB, static_cast<std::size_t>(image.width) * 2},
                       image.levels.data());
}

std::string encoded_grey_png(const std::string& name, Index height, Index width, std::span<const std::uint8_t> levels) {
  return encoded_noise(name, height, width, {PNG_COLOR_TYPE_GRAY, 8, PNG_FILTER_NONE, static_cast<std::size_t>(width)},
                       levels.data());
}

std::string encoded_png(const std::string& name, const Image& image, PngContent content) {
  check(image.height > 0 && image.width > 0 && static_cast<Index>(image.rgb.size()) == image.height * image.width * 3,
        name, ": cannot be written: a ", image.height, "x", image.width, "x3 image has ", image.rgb.size(), " values");
  switch (content) {
    case PngContent::photograph:
      return encoded_noise(name, image.height, image.width,
                           {PNG_COLOR_TYPE_RGB, 8, PNG_FILTER_AVG, static_cast<std::size_t>(image.width) * 3},
                           image.rgb.data());
    case PngContent::drawing:
      break;
  }
  return encoded(name, image.height, image.width, PNG_FORMAT_RGB, image.rgb.data());
}

}  // namespace svnet::io
