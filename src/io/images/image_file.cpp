#include "io/images/image_file.h"

#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "image/oriented.h"
#include "io/files/atomic_file.h"
#include "io/images/image_codecs.h"

namespace svnet::io {

namespace {

Image decoded(const std::string& name, Bytes file) {
  if (std::optional<Image> image = decode_image(name, file)) return *std::move(image);
  const std::string instead = recognised_instead(file);
  fail(name, ": is not a PNG, JPEG or WebP image", instead.empty() ? ", whatever its name says" : instead);
}

}  // namespace

StoredImage read_stored_image(const std::filesystem::path& path) {
  return decode_stored_image(path.string(), image_contents(path));
}

StoredImage decode_stored_image(const std::string& name, Bytes file) {
  return {decoded(name, file), exif_orientation(file)};
}

Image read_image(const std::filesystem::path& path, ExifOrientation exif) {
  StoredImage stored = read_stored_image(path);
  switch (exif) {
    case ExifOrientation::ignore:
      return std::move(stored.image);
    case ExifOrientation::obey:
      return oriented(std::move(stored.image), stored.exif_orientation);
  }
  return {};
}

int read_exif_orientation(const std::filesystem::path& path) try {
  return exif_orientation(image_contents(path));
} catch (const Error&) {
  return 1;
}

void write_png(const std::filesystem::path& path, const Image& image) {
  write_atomically(path, encoded_png(path.string(), image));
}

}  // namespace svnet::io
