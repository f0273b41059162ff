#include <bit>
#include <csetjmp>
#include <cstring>
#include <new>
#include <vector>

#include <png.h>

#include "base/error.h"
#include "io/images/image_codecs.h"
#include "io/images/png_errors.h"

namespace svnet::io {
namespace {

static_assert(std::endian::native == std::endian::little);  // the levels of a PNG are big-endian: png_set_swap

/// libpng with errors that return here (PngErrors). It checks the CRC of every critical chunk, and reading up to the
/// end chunk refuses truncated files.
class PngDecoder {
 public:
  explicit PngDecoder(Bytes file) : rest_(file) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &errors_, PngErrors::return_from, PngErrors::ignore);
    info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw std::bad_alloc();
    }
  }
  ~PngDecoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngDecoder(const PngDecoder&) = delete;
  PngDecoder& operator=(const PngDecoder&) = delete;

  bool read_header() {
    if (setjmp(errors_.back) != 0) return false;
    png_set_read_fn(png_, this, [](png_structp png, png_bytep out, std::size_t size) {
      auto* decoder = static_cast<PngDecoder*>(png_get_io_ptr(png));
      if (size > decoder->rest_.size()) png_error(png, "the file ends too early");
      std::memcpy(out, decoder->rest_.data(), size);
      decoder->rest_ = decoder->rest_.subspan(size);
    });
    // Only what the pixels need. libpng takes as much memory for the others as the file says that they are long.
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_read_info(png_, info_);
    return true;
  }

  Index height() const { return png_get_image_height(png_, info_); }
  Index width() const { return png_get_image_width(png_, info_); }
  const char* reason() const { return errors_.message; }

  bool is_grey16() const {
    return png_get_color_type(png_, info_) == PNG_COLOR_TYPE_GRAY && png_get_bit_depth(png_, info_) == 16;
  }

  /// rows: the addresses of height rows of width 16-bit levels.
  bool read_grey16(std::uint8_t** rows) {
    if (setjmp(errors_.back) != 0) return false;
    png_set_swap(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    png_read_image(png_, rows);
    png_read_end(png_, nullptr);
    return true;
  }

  /// rows: the addresses of height rows of (width, 3) bytes.
  bool read_pixels(std::uint8_t** rows) {
    if (setjmp(errors_.back) != 0) return false;
    const int color = png_get_color_type(png_, info_);
    png_set_strip_16(png_);
    if (color == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png_);
    if ((color & PNG_COLOR_MASK_COLOR) == 0) {
      png_set_expand_gray_1_2_4_to_8(png_);
      png_set_gray_to_rgb(png_);
    }
    png_set_strip_alpha(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    if (png_get_rowbytes(png_, info_) != std::size_t{3} * png_get_image_width(png_, info_))
      png_error(png_, "its pixels cannot be turned into RGB");
    png_read_image(png_, rows);
    png_read_end(png_, nullptr);
    return true;
  }

 private:
  Bytes rest_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  PngErrors errors_{};
};

}  // namespace

Image decode_png(const std::string& name, Bytes file) {
  PngDecoder decoder(file);
  if (!decoder.read_header()) fail_damaged(name, "PNG", decoder.reason());
  Image image = image_of_size(name, decoder.height(), decoder.width());
  std::vector<std::uint8_t*> rows(static_cast<std::size_t>(image.height));
  for (Index row = 0; row < image.height; ++row) rows[row] = image.rgb.data() + row * image.width * 3;
  if (!decoder.read_pixels(rows.data())) fail_damaged(name, "PNG", decoder.reason());
  return image;
}

Grey16 decode_grey16_png(const std::string& name, Bytes file) {
  PngDecoder decoder(file);
  if (!decoder.read_header()) fail_damaged(name, "PNG", decoder.reason());
  check(decoder.is_grey16(), name, ": is a PNG of another kind, expected 16-bit grey, depth in millimetres");
  check_image_size(name, decoder.height(), decoder.width());
  Grey16 image{decoder.height(), decoder.width(), {}};
  image.levels.resize(static_cast<std::size_t>(image.height * image.width));
  std::vector<std::uint8_t*> rows(static_cast<std::size_t>(image.height));
  for (Index row = 0; row < image.height; ++row)
    rows[row] = reinterpret_cast<std::uint8_t*>(image.levels.data() + row * image.width);
  if (!decoder.read_grey16(rows.data())) fail_damaged(name, "PNG", decoder.reason());
  return image;
}

}  // namespace svnet::io
