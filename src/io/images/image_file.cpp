#include "io/images/image_file.h"

#include <string>
#include <vector>

#include "base/error.h"
#include "io/files/atomic_file.h"
#include "io/images/image_codecs.h"

namespace svnet {

Image read_image(const std::filesystem::path& path) {
  const std::vector<std::uint8_t> file = picture_contents(path);
  const std::string name = path.string();
  if (has_bytes(file, 0, "\xff\xd8\xff")) return decode_jpeg(name, file);
  if (has_bytes(file, 0, "\x89PNG\r\n\x1a\n")) return decode_png(name, file);
  if (has_bytes(file, 0, "RIFF") && has_bytes(file, 8, "WEBP")) return decode_webp(name, file);
  fail(name, ": is not a PNG, JPEG or WebP picture, whatever its name says");
}

void write_png(const std::filesystem::path& path, const Image& image) {
  write_atomically(path, encoded_png(path.string(), image));
}

}  // namespace svnet
