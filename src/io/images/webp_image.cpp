#include <new>

#include <webp/decode.h>

#include "base/error.h"
#include "io/images/image_codecs.h"

namespace svnet::io {
namespace {

/// The size of the file according to its header: the length of the RIFF chunk and the 8 bytes before it.
std::uint64_t stated_size(Bytes file) {
  return (std::uint64_t{file[4]} | std::uint64_t{file[5]} << 8 | std::uint64_t{file[6]} << 16 |
          std::uint64_t{file[7]} << 24) +
         8;
}

}  // namespace

Image decode_webp(const std::string& name, Bytes file) {
  if (stated_size(file) > file.size())
    fail_damaged(name, "WebP", joined("it has ", file.size(), " bytes of ", stated_size(file)));
  WebPDecoderConfig config;
  check(WebPInitDecoderConfig(&config) != 0, "libwebp is another version than at compile time");
  if (WebPGetFeatures(file.data(), file.size(), &config.input) != VP8_STATUS_OK)
    fail_damaged(name, "WebP", "its header cannot be read");
  check(config.input.has_animation == 0, name, ": is an animated WebP, expected a single image");
  Image image = image_of_size(name, config.input.height, config.input.width);
  config.output.colorspace = MODE_RGB;
  config.output.is_external_memory = 1;
  config.output.u.RGBA = {image.rgb.data(), static_cast<int>(image.width * 3), image.rgb.size()};
  const VP8StatusCode status = WebPDecode(file.data(), file.size(), &config);
  if (status == VP8_STATUS_OUT_OF_MEMORY) throw std::bad_alloc();
  if (status != VP8_STATUS_OK) fail_damaged(name, "WebP", "its pixels cannot be decoded");
  return image;
}

}  // namespace svnet::io
