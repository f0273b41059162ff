#include "io/images/texture_image.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>

#include <stb/stb_image.h>
#include <tiffio.h>

#include "base/error.h"
#include "base/text.h"

namespace svnet::io {
namespace {

std::uint64_t number_at(Bytes file, std::size_t at, std::size_t bytes) {
  std::uint64_t number = 0;
  for (std::size_t i = bytes; i-- > 0;) number = number << 8 | (at + i < file.size() ? file[at + i] : 0u);
  return number;
}

/// The bytes that pixels need; stb takes missing ones for black. It reads no BMP that is compressed.
std::uint64_t bmp_bytes(Bytes file, const Image& image) {
  const std::uint64_t bits = number_at(file, number_at(file, 14, 4) < 40 ? 24 : 28, 2);
  return number_at(file, 10, 4) +
         (static_cast<std::uint64_t>(image.width) * bits + 31) / 32 * 4 * static_cast<std::uint64_t>(image.height);
}
/// The same of pixels that are not compressed; 0 if they are.
std::uint64_t tga_bytes(Bytes file, const Image& image) {
  constexpr std::size_t kHeader = 18;
  if (number_at(file, 2, 1) > 3) return 0;
  return kHeader + number_at(file, 0, 1) + number_at(file, 5, 2) * ((number_at(file, 7, 1) + 7) / 8) +
         static_cast<std::uint64_t>(image.width * image.height) * ((number_at(file, 16, 1) + 7) / 8);
}

/// BMP, TGA and GIF.
Image decode_with_stb(const std::string& name, Bytes file, const char* kind,
                      std::uint64_t (*needed_bytes)(Bytes, const Image&) = nullptr) {
  const auto size = static_cast<int>(file.size());
  int width = 0, height = 0, channels = 0;
  if (stbi_info_from_memory(file.data(), size, &width, &height, &channels) == 0)
    fail_damaged(name, kind, stbi_failure_reason());
  Image image = image_of_size(name, height, width);
  if (const std::uint64_t needed = needed_bytes != nullptr ? needed_bytes(file, image) : 0; needed > file.size())
    fail_damaged(name, kind, joined("it has ", file.size(), " bytes of ", needed));
  const std::unique_ptr<stbi_uc, void (*)(void*)> rgb(
      stbi_load_from_memory(file.data(), size, &width, &height, &channels, 3), stbi_image_free);
  if (rgb == nullptr || width != image.width || height != image.height)
    fail_damaged(name, kind, rgb == nullptr ? stbi_failure_reason() : "its size changes");
  std::copy(rgb.get(), rgb.get() + image.rgb.size(), image.rgb.begin());
  return image;
}

/// A file in memory as libtiff reads it, and what it complained about first.
struct TiffFile {
  Bytes bytes;
  std::size_t place = 0;
  std::string complaint;
};

tsize_t read_tiff(thandle_t handle, void* to, tsize_t count) {
  auto& file = *static_cast<TiffFile*>(handle);
  const std::size_t rest = file.bytes.size() - std::min(file.place, file.bytes.size());
  const std::size_t taken = std::min(rest, static_cast<std::size_t>(std::max<tsize_t>(count, 0)));
  if (taken > 0) std::memcpy(to, file.bytes.data() + file.place, taken);
  file.place += taken;
  return static_cast<tsize_t>(taken);
}

toff_t seek_tiff(thandle_t handle, toff_t offset, int whence) {
  auto& file = *static_cast<TiffFile*>(handle);
  file.place = static_cast<std::size_t>(offset) + (whence == SEEK_CUR   ? file.place
                                                   : whence == SEEK_END ? file.bytes.size()
                                                                        : 0);
  return file.place;
}

int note_complaint(TIFF*, void* user, const char*, const char* format, va_list arguments) {
  auto& file = *static_cast<TiffFile*>(user);
  if (!file.complaint.empty()) return 1;
  char text[200];
  std::vsnprintf(text, sizeof text, format, arguments);
  file.complaint = printable(text);
  return 1;
}

int ignore_warning(TIFF*, void*, const char*, const char*, va_list) { return 1; }

Image decode_tiff(const std::string& name, Bytes bytes) {
  constexpr tmsize_t kMostMemory = tmsize_t{1} << 30;
  TiffFile file{bytes, 0, {}};
  const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                             TIFFOpenOptionsFree);
  if (options == nullptr) throw std::bad_alloc();
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), kMostMemory);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), note_complaint, &file);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignore_warning, nullptr);
  const std::unique_ptr<TIFF, void (*)(TIFF*)> tiff(
      TIFFClientOpenExt(
          "texture", "rm", &file, read_tiff, [](thandle_t, void*, tsize_t) { return tsize_t{0}; }, seek_tiff,
          [](thandle_t) { return 0; },
          [](thandle_t handle) { return static_cast<toff_t>(static_cast<TiffFile*>(handle)->bytes.size()); },
          [](thandle_t, void**, toff_t*) { return 0; }, [](thandle_t, void*, toff_t) {}, options.get()),
      TIFFClose);
  // libtiff says of sizes that a damaged file asks for, as of memory that is missing, that it cannot allocate them.
  const auto fail_tiff = [&] {
    check(file.complaint.find("memory") == std::string::npos && file.complaint.find("allocat") == std::string::npos,
          name, ": cannot be decoded as TIFF (", file.complaint, "); the file is damaged, or memory is missing");
    fail_damaged(name, "TIFF", file.complaint.empty() ? "it cannot be decoded" : file.complaint);
  };
  if (tiff == nullptr) fail_tiff();
  std::uint32_t width = 0, height = 0;  // stay 0, which image_of_size refuses, if the file does not have them
  TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &height);
  Image image = image_of_size(name, height, width);
  std::vector<std::uint32_t> pixels(std::size_t{width} * height);
  if (TIFFReadRGBAImageOriented(tiff.get(), width, height, pixels.data(), ORIENTATION_TOPLEFT, 1) == 0) fail_tiff();
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    // Colours come multiplied by the alpha.
    const std::uint32_t pixel = pixels[i], alpha = std::max(TIFFGetA(pixel), 1u);
    const auto level = [&](std::uint32_t c) {
      return static_cast<std::uint8_t>(std::min(255u, (c * 255 + alpha / 2) / alpha));
    };
    image.rgb[3 * i] = level(TIFFGetR(pixel));
    image.rgb[3 * i + 1] = level(TIFFGetG(pixel));
    image.rgb[3 * i + 2] = level(TIFFGetB(pixel));
  }
  return image;
}

bool is_tga(const std::string& name, Bytes file) {
  return lower_case(name).ends_with(".tga") ||
         (file.size() > 26 && has_bytes(file, file.size() - 18, "TRUEVISION-XFILE."));
}

}  // namespace

Image decode_texture(const std::string& name, Bytes file) {
  check(file.size() < std::size_t{1} << 30, name, ": has ", file.size(), " bytes, more than an image needs");
  if (std::optional<Image> image = decode_image(name, file)) return *std::move(image);
  if (has_bytes(file, 0, std::string_view("II*\0", 4)) || has_bytes(file, 0, std::string_view("MM\0*", 4)))
    return decode_tiff(name, file);
  if (has_bytes(file, 0, "BM")) return decode_with_stb(name, file, "BMP", bmp_bytes);
  if (has_bytes(file, 0, "GIF8")) return decode_with_stb(name, file, "GIF");
  check(!has_bytes(file, 0, "\xabKTX"), name, ": is a KTX image, which is not read; convert it to PNG");
  check(!has_bytes(file, 0, "DDS "), name, ": is a DDS image, which is not read; convert it to PNG");
  const std::string instead = recognised_instead(file);
  check(is_tga(name, file) && instead.empty(), name,
        ": is no image of a known kind (PNG, JPEG, WebP, BMP, TGA, TIFF or GIF)", instead);
  return decode_with_stb(name, file, "TGA", tga_bytes);
}

}  // namespace svnet::io
