#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <vector>

#include <jerror.h>
#include <jpeglib.h>

#include "base/error.h"
#include "io/images/image_codecs.h"

namespace svnet::io {
namespace {

/// libjpeg with errors that return here instead of ending the process. A warning that means lost pixels is an error
/// too: libjpeg fills the missing part of a truncated file with grey and only warns on stderr.
///
/// The functions that call setjmp have no local objects with destructors, because longjmp would skip those.
class JpegDecoder {
 public:
  explicit JpegDecoder(Bytes file) : file_(file) {}
  ~JpegDecoder() { jpeg_destroy_decompress(&jpeg_); }
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;

  bool read_header() {
    jpeg_.err = jpeg_std_error(&errors_.base);
    errors_.base.error_exit = [](j_common_ptr jpeg) { give_up(jpeg); };
    errors_.base.emit_message = [](j_common_ptr jpeg, int level) {
      if (level < 0 && loses_pixels(jpeg->err->msg_code)) give_up(jpeg);
    };
    if (setjmp(errors_.back) != 0) return false;
    jpeg_create_decompress(&jpeg_);
    jpeg_mem_src(&jpeg_, file_.data(), file_.size());
    jpeg_read_header(&jpeg_, TRUE);
    return true;
  }

  Index height() const { return jpeg_.image_height; }
  Index width() const { return jpeg_.image_width; }
  int channels() const { return jpeg_.num_components; }
  const char* reason() const { return errors_.message; }

  /// Decodes the whole file, including the end marker. pixels (height, width, 3): RGB; of a file with four channels
  /// (height, width, 4): CMYK as stored.
  bool read_pixels(std::uint8_t* pixels) {
    if (setjmp(errors_.back) != 0) return false;
    const std::size_t channels = jpeg_.num_components == 4 ? 4 : 3;
    jpeg_.out_color_space = channels == 4 ? JCS_CMYK : JCS_RGB;
    jpeg_start_decompress(&jpeg_);
    while (jpeg_.output_scanline < jpeg_.output_height) {
      JSAMPROW row = pixels + std::size_t{jpeg_.output_scanline} * jpeg_.output_width * channels;
      jpeg_read_scanlines(&jpeg_, &row, 1);
    }
    jpeg_finish_decompress(&jpeg_);
    return true;
  }

 private:
  struct Errors {
    jpeg_error_mgr base;  // first, so that libjpeg's pointer to it is a pointer to Errors
    std::jmp_buf back;
    char message[JMSG_LENGTH_MAX];
  };

  [[noreturn]] static void give_up(j_common_ptr jpeg) {
    auto* errors = reinterpret_cast<Errors*>(jpeg->err);
    errors->base.format_message(jpeg, errors->message);
    std::longjmp(errors->back, 1);
  }

  /// Warnings about unusual headers and about bytes between segments do not affect pixels.
  static bool loses_pixels(int warning) {
    return warning != JWRN_EXTRANEOUS_DATA && warning != JWRN_ADOBE_XFORM && warning != JWRN_JFIF_MAJOR;
  }

  Bytes file_;
  Errors errors_{};
  jpeg_decompress_struct jpeg_{};
};

/// a * b / 255, rounded.
std::uint8_t product(int a, int b) {
  const int x = a * b + 128;
  return static_cast<std::uint8_t>(((x >> 8) + x) >> 8);
}

/// As Pillow converts: the four channels are inverted, as Adobe's programs store them, and black darkens the others.
void convert_cmyk(const std::vector<std::uint8_t>& stored, std::vector<std::uint8_t>& rgb) {
  for (std::size_t i = 0; i < rgb.size() / 3; ++i) {
    const int white = stored[4 * i + 3];  // 255 - black
    for (std::size_t c = 0; c < 3; ++c)
      rgb[3 * i + c] = static_cast<std::uint8_t>(std::max(0, white - product(255 - stored[4 * i + c], white)));
  }
}

}  // namespace

Image decode_jpeg(const std::string& name, Bytes file) {
  JpegDecoder decoder(file);
  if (!decoder.read_header()) fail_damaged(name, "JPEG", decoder.reason());
  const int channels = decoder.channels();
  check(channels == 1 || channels == 3 || channels == 4, name, ": is a JPEG image with ", channels,
        " colour channels, expected 1 (grey), 3 or 4 (CMYK); convert it to RGB");
  Image image = image_of_size(name, decoder.height(), decoder.width());
  std::vector<std::uint8_t> stored(channels == 4 ? image.rgb.size() / 3 * 4 : 0);
  if (!decoder.read_pixels(channels == 4 ? stored.data() : image.rgb.data()))
    fail_damaged(name, "JPEG", decoder.reason());
  if (channels == 4) convert_cmyk(stored, image.rgb);
  return image;
}

}  // namespace svnet::io
