#include "io/images/image_codecs.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <new>
#include <system_error>

#include "base/error.h"
#include "base/text.h"
#include "io/files/file_format.h"

namespace svnet::io {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaximumFileSize = std::uintmax_t{1} << 30;

}  // namespace

std::vector<std::uint8_t> image_contents(const fs::path& path) {
  const std::string name = path.string();
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  check(status.type() != fs::file_type::not_found, name, ": no such file");
  check(!fs::is_directory(status), name, ": is a folder, expected an image (PNG, JPEG or WebP)");
  check(!fs::exists(status) || fs::is_regular_file(status) || fs::is_fifo(status), name,
        ": is not a regular file, expected an image");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  check(file.is_open(), name, ": cannot be read: ", std::generic_category().message(errno));
  // A pipe has no size: it is read in pieces.
  const std::uintmax_t size = fs::is_fifo(status) ? kMaximumFileSize : fs::file_size(path, error);
  check(!error, name, ": cannot be read: ", error.message());
  check(size <= kMaximumFileSize, name, ": has ", size, " bytes, more than an image of 64 megapixels needs");
  std::vector<std::uint8_t> bytes;
  constexpr std::uintmax_t kPiece = 1 << 20;
  while (bytes.size() < size && file) {
    const std::size_t before = bytes.size();
    bytes.resize(before + std::min(size - before, fs::is_fifo(status) ? kPiece : size));
    file.read(reinterpret_cast<char*>(bytes.data() + before), static_cast<std::streamsize>(bytes.size() - before));
    bytes.resize(before + static_cast<std::size_t>(file.gcount()));
  }
  if (fs::is_fifo(status)) {
    check(!file.bad(), name, ": cannot be read: ", std::generic_category().message(errno != 0 ? errno : EIO));
    check(bytes.size() < kMaximumFileSize, name, ": has more bytes than an image of 64 megapixels needs");
  } else {
    check(bytes.size() == size, name, ": cannot be read: ", std::generic_category().message(errno != 0 ? errno : EIO));
  }
  check(!bytes.empty(), name, ": is empty, expected an image (PNG, JPEG or WebP)");
  return bytes;
}

bool has_bytes(Bytes file, std::size_t offset, std::string_view expected) {
  return file.size() >= offset + expected.size() &&
         std::equal(expected.begin(), expected.end(), file.begin() + static_cast<std::ptrdiff_t>(offset),
                    [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

ImageFormat image_format(Bytes file) {
  if (has_bytes(file, 0, "\xff\xd8\xff")) return ImageFormat::jpeg;
  if (has_bytes(file, 0, "\x89PNG\r\n\x1a\n")) return ImageFormat::png;
  if (has_bytes(file, 0, "RIFF") && has_bytes(file, 8, "WEBP")) return ImageFormat::webp;
  return ImageFormat::other;
}

std::optional<Image> decode_image(const std::string& name, Bytes file) {
  switch (image_format(file)) {
    case ImageFormat::jpeg:
      return decode_jpeg(name, file);
    case ImageFormat::png:
      return decode_png(name, file);
    case ImageFormat::webp:
      return decode_webp(name, file);
    case ImageFormat::other:
      break;
  }
  return {};
}

std::string recognised_instead(Bytes file) {
  return recognised_instead(std::string_view(reinterpret_cast<const char*>(file.data()), file.size()));
}

void check_image_size(const std::string& name, Index height, Index width) {
  check(height > 0 && width > 0, name, ": has no pixels (", width, "x", height, ")");
  check(height <= kMostPixels / width, name, ": has ", width, "x", height,
        " pixels, more than the 64 megapixels that are read; make it smaller");
}

Image image_of_size(const std::string& name, Index height, Index width) {
  check_image_size(name, height, width);
  return {height, width, std::vector<std::uint8_t>(static_cast<std::size_t>(height * width * 3))};
}

void fail_damaged(const std::string& name, const char* kind, const std::string& reason) {
  const std::string lower = lower_case(reason);
  if (lower.find("memory") != std::string::npos || lower == "outofmem") throw std::bad_alloc();
  fail(name, ": is a damaged or incomplete ", kind, " image (", reason, "); replace the file");
}

}  // namespace svnet::io
