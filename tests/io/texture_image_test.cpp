#include "io/images/texture_image.h"

#include <catch2/catch.hpp>

#include "base/error.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
using Catch::Contains;
using namespace std::string_literals;

namespace {

/// `size` bytes of a number, the smallest first.
std::string le(std::uint64_t number, std::size_t size) {
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i, number >>= 8) bytes += static_cast<char>(number);
  return bytes;
}

Image decode(const std::string& name, const std::string& file) {
  return decode_texture(name, {reinterpret_cast<const std::uint8_t*>(file.data()), file.size()});
}

/// The levels of the file's pixels, or the Error.
std::string levels_or_error(const std::string& name, const std::string& file) {
  try {
    const Image image = decode(name, file);
    std::string text = joined(image.width, 'x', image.height, ':');
    for (const std::uint8_t level : image.rgb) text += joined(' ', int{level});
    return text;
  } catch (const Error& error) {
    return error.what();
  }
}

/// Two pixels in one row, red 200 and blue 100. `bits` of 24: BGR; of 16 with masks: RGB 565.
const std::string kBgr = le(0xc80000, 3) + le(0x000064, 3), kTwoPixels = "2x1: 200 0 0 0 0 100";

std::string bmp(std::uint64_t compression, std::uint64_t bits, const std::string& masks, const std::string& pixels) {
  const std::string information =
      le(40, 4) + le(2, 4) + le(1, 4) + le(1, 2) + le(bits, 2) + le(compression, 4) + le(0, 20) + masks;
  return "BM" + le(0, 8) + le(14 + information.size(), 4) + information + pixels;
}

std::string tga(int kind, const std::string& pixels, int bits = 24) {
  constexpr int kFromTop = 0x20;
  return le(0, 2) + le(static_cast<std::uint64_t>(kind), 1) + le(0, 9) + le(2, 2) + le(1, 2) +
         le(static_cast<std::uint64_t>(bits), 1) + le(kFromTop, 1) + pixels;
}

/// A TIFF file of one row of grey levels. Each entry of its directory is 12 bytes: tag, type, count, value.
struct Tiff {
  bool big_endian = false;
  std::uint64_t width = 2, height = 1, compression = 1, offset = 8, samples = 1;

  std::string number(std::uint64_t value, std::size_t size) const {
    const std::string bytes = le(value, size);
    return big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
  }
  std::string entry(std::uint64_t tag, std::uint64_t value) const {
    return number(tag, 2) + number(4, 2) + number(1, 4) + number(value, 4);  // 4: a number of 32 bits
  }
  std::string short_entry(std::uint64_t tag, std::uint64_t value) const {
    return number(tag, 2) + number(3, 2) + number(1, 4) + number(value, 2) + number(0, 2);
  }
  std::string file() const {
    std::string entries;
    if (width > 0) entries += entry(256, width);
    if (height > 0) entries += entry(257, height);
    entries += short_entry(258, 8) + short_entry(259, compression) + short_entry(262, 1) + entry(273, offset) +
               short_entry(277, samples) + entry(278, 1) + entry(279, 2);
    return (big_endian ? "MM" : "II") + number(42, 2) + number(12, 4) + "\x0a\xc8\0\0"s +
           number(entries.size() / 12, 2) + entries + number(0, 4);
  }
};

}  // namespace

TEST_CASE("a BMP is read, with a header of Windows or OS/2, with masks of its colours") {
  CHECK(levels_or_error("a.bmp", bmp(0, 24, "", kBgr + le(0, 2))) == kTwoPixels);
  const std::string os2 = "BM" + le(0, 8) + le(26, 4) + le(12, 4) + le(2, 2) + le(1, 2) + le(1, 2) + le(24, 2);
  CHECK(levels_or_error("a.bmp", os2 + kBgr + le(0, 2)) == kTwoPixels);
  const std::string masks = le(0xff, 4) + le(0xff00, 4) + le(0xff0000, 4);
  CHECK(levels_or_error("a.bmp", bmp(3, 32, masks, le(0xc8, 4) + le(0x640000, 4))) == kTwoPixels);
}

TEST_CASE("a BMP that is cut, compressed or damaged is refused") {
  const std::string whole = bmp(0, 24, "", kBgr + le(0, 2));
  CHECK(levels_or_error("a.bmp", whole.substr(0, whole.size() - 1)) ==
        "a.bmp: is a damaged or incomplete BMP image (it has 61 bytes of 62); replace the file");
  for (std::size_t size = 2; size < whole.size(); ++size)
    CHECK_THAT(levels_or_error("a.bmp", whole.substr(0, size)),
               Catch::StartsWith("a.bmp: is a damaged or incomplete BMP image ("));
  for (const std::uint64_t compression : {1u, 2u, 4u, 5u})  // run lengths, JPEG, PNG
    CHECK_THAT(levels_or_error("a.bmp", bmp(compression, 8, "", kBgr)),
               Catch::StartsWith("a.bmp: is a damaged or incomplete BMP image ("));
  // stb takes an unknown compression for none.
  CHECK(levels_or_error("a.bmp", bmp(0xffffffff, 24, "", kBgr.substr(1) + le(0, 2))) ==
        "a.bmp: is a damaged or incomplete BMP image (it has 61 bytes of 62); replace the file");
}

TEST_CASE("the contents of a texture decide before its name") {
  const Image image{1, 2, {200, 0, 0, 0, 0, 100}};
  CHECK(levels_or_error("wood.tga", encoded_png("wood.tga", image)) == kTwoPixels);
  CHECK(levels_or_error("wood.tga", bmp(0, 24, "", kBgr + le(0, 2))) == kTwoPixels);
}

TEST_CASE("a TGA is told by its name or by its footer") {
  const std::string file = tga(2, kBgr), footer = le(0, 8) + "TRUEVISION-XFILE."s + le(0, 1);
  CHECK(levels_or_error("wood.TGA", file) == kTwoPixels);
  CHECK(levels_or_error("wood", file + footer) == kTwoPixels);
  const std::string unknown = ": is no image of a known kind (PNG, JPEG, WebP, BMP, TGA, TIFF or GIF)";
  CHECK(levels_or_error("wood", file) == "wood" + unknown);
  CHECK(levels_or_error("wood", file + std::string(footer.size(), 'x')) == "wood" + unknown);
  CHECK_THAT(levels_or_error("wood.tga", "<!DOCTYPE html><html>"),
             Catch::StartsWith("wood.tga" + unknown + ", but a web page (HTML)"));
}

TEST_CASE("a TGA may be compressed, one that is cut is refused") {
  CHECK(levels_or_error("a.tga", tga(10, "\x01" + kBgr)) == kTwoPixels);  // two pixels as they are
  CHECK(levels_or_error("a.tga", tga(10, "\x81" + kBgr.substr(0, 3))) == "2x1: 200 0 0 200 0 0");  // one, twice
  CHECK(levels_or_error("a.tga", tga(2, kBgr.substr(1))) ==
        "a.tga: is a damaged or incomplete TGA image (it has 23 bytes of 24); replace the file");
  CHECK_THAT(levels_or_error("a.tga", tga(2, kBgr, 7)), Catch::StartsWith("a.tga: is a damaged or incomplete TGA"));
}

TEST_CASE("a GIF is read, one whose pixels are damaged is refused") {
  const std::string header = "GIF89a\1\0\1\0\x80\0\0\x0a\x14\x1e\0\0\0,\0\0\0\0\1\0\1\0\0\2"s;
  CHECK(levels_or_error("a.gif", header + "\2D\1\0;"s) == "1x1: 10 20 30");
  CHECK_THAT(levels_or_error("a.gif", header + "\2\xff\xff\0;"s),
             Catch::StartsWith("a.gif: is a damaged or incomplete GIF image ("));
  CHECK_THAT(levels_or_error("a.gif", "GIF8"), Catch::StartsWith("a.gif: is a damaged or incomplete GIF image ("));
}

TEST_CASE("a TIFF is read in either byte order") {
  CHECK(levels_or_error("a.tif", Tiff{}.file()) == "2x1: 10 10 10 200 200 200");
  CHECK(levels_or_error("a.tif", Tiff{.big_endian = true}.file()) == "2x1: 10 10 10 200 200 200");
}

TEST_CASE("a TIFF that is damaged is refused with a reason") {
  const std::string damaged = "a.tif: is a damaged or incomplete TIFF image (";
  const std::string whole = Tiff{}.file();
  for (std::size_t size = 4; size < whole.size() - 4; ++size) {
    CAPTURE(size);
    CHECK_THAT(levels_or_error("a.tif", whole.substr(0, size)), Catch::StartsWith("a.tif: "));
  }
  CHECK_THAT(levels_or_error("a.tif", Tiff{.offset = 4000}.file()),
             Catch::StartsWith(damaged));  // pixels beyond its end
  CHECK_THAT(levels_or_error("a.tif", Tiff{.compression = 77}.file()), Catch::StartsWith(damaged));
  CHECK(levels_or_error("a.tif", Tiff{.width = 0}.file()) ==
        damaged + "Computed scanline size is zero); replace the file");
  CHECK(levels_or_error("a.tif", Tiff{.height = 0}.file()) ==
        damaged + "Cannot handle zero number of strips); replace the file");
  CHECK_THAT(levels_or_error("a.tif", Tiff{.width = 100'000, .height = 100'000}.file()),
             Contains("a.tif: has 100000x100000 pixels, more than the 64 megapixels"));
}

TEST_CASE("a TIFF whose pixels would take more memory than is given is refused as such") {
  CHECK_THAT(levels_or_error("a.tif", Tiff{.width = 40'000, .compression = 5, .samples = 60'000}.file()),
             Catch::StartsWith("a.tif: cannot be decoded as TIFF (") &&
                 Contains("; the file is damaged, or memory is missing"));
}

TEST_CASE("textures of kinds that are not read are named") {
  CHECK(levels_or_error("a", "\xabKTX 11\xbb\r\n\x1a\n") == "a: is a KTX image, which is not read; convert it to PNG");
  CHECK(levels_or_error("a", "DDS |") == "a: is a DDS image, which is not read; convert it to PNG");
}
