// The orientation in the EXIF data of an image: the tag 0x0112 of the first directory of a TIFF file, which is a
// segment of a JPEG file (APP1) or a chunk of a PNG (eXIf) or WebP file (EXIF). Damaged EXIF data count as none.
#include <algorithm>

#include "io/images/image_codecs.h"

namespace svnet::io {
namespace {

constexpr std::size_t kExifPrefix = 6;  // "Exif\0\0" before the TIFF file; PNG and most WebP files do without it

/// Numbers in a file, in either byte order; 0 beyond its end.
class Numbers {
 public:
  Numbers(Bytes file, bool big_endian) : file_(file), big_endian_(big_endian) {}
  std::uint32_t two(std::size_t at) const { return number(at, 2); }
  std::uint32_t four(std::size_t at) const { return number(at, 4); }

 private:
  std::uint32_t number(std::size_t at, std::size_t size) const {
    if (at > file_.size() || file_.size() - at < size) return 0;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i) value = value << 8 | file_[at + (big_endian_ ? i : size - 1 - i)];
    return value;
  }

  Bytes file_;
  bool big_endian_;
};

std::size_t next_jpeg_segment(const Numbers& n, std::size_t at) { return at + 2 + n.two(at + 2); }

/// The TIFF file in a JPEG file; empty if there is none before the pixels.
Bytes jpeg_exif(Bytes file) {
  const Numbers n(file, true);
  for (std::size_t at = 2; at + 4 < file.size() && file[at] == 0xff; at = next_jpeg_segment(n, at)) {
    if (file[at + 1] == 0xda) break;  // the pixels
    const std::size_t end = next_jpeg_segment(n, at);
    if (end > file.size() || end < at + 4) break;
    if (file[at + 1] == 0xe1 && has_bytes(file, at + 4, std::string_view("Exif\0\0", kExifPrefix)))
      return file.subspan(at + 4 + kExifPrefix, end - std::min(end, at + 4 + kExifPrefix));
  }
  return {};
}

/// Chunks from `first` on: 8 bytes with the length at `length_at` and the name at `name_at`, then the contents, then
/// `tail` bytes. padded: to an even length.
struct ChunkLayout {
  std::size_t first, length_at, name_at, tail;
  bool big_endian, padded;
};

/// The contents of the first chunk of that name; empty if there is none.
Bytes chunk(Bytes file, const ChunkLayout& layout, std::string_view name) {
  const Numbers n(file, layout.big_endian);
  for (std::size_t at = layout.first; at + 8 <= file.size();) {
    const std::size_t length = n.four(at + layout.length_at);
    if (length > file.size() - at - 8) break;
    if (has_bytes(file, at + layout.name_at, name)) return file.subspan(at + 8, length);
    at += 8 + length + layout.tail + (layout.padded ? length % 2 : 0);
  }
  return {};
}

}  // namespace

int exif_orientation(Bytes file) {
  Bytes tiff;
  switch (image_format(file)) {
    case ImageFormat::jpeg:
      tiff = jpeg_exif(file);
      break;
    case ImageFormat::png:
      tiff = chunk(file, {8, 0, 4, 4, true, false}, "eXIf");
      break;
    case ImageFormat::webp:
      tiff = chunk(file, {12, 4, 0, 0, false, true}, "EXIF");
      break;
    case ImageFormat::other:
      return 1;
  }
  if (has_bytes(tiff, 0, std::string_view("Exif\0\0", kExifPrefix))) tiff = tiff.subspan(kExifPrefix);
  const bool big_endian = has_bytes(tiff, 0, "MM");
  if (!big_endian && !has_bytes(tiff, 0, "II")) return 1;
  const Numbers n(tiff, big_endian);
  const std::size_t directory = n.four(4), entries = n.two(directory);
  constexpr std::size_t kEntry = 12;
  constexpr std::uint32_t kOrientation = 0x0112;
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t entry = directory + 2 + i * kEntry;
    if (n.two(entry) != kOrientation) continue;
    const std::uint32_t value = n.two(entry + 8);
    return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
  }
  return 1;
}

}  // namespace svnet::io
