#include "io/images/image_file.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>
#include <thread>

#include <sys/stat.h>

#include "base/sha256.h"
#include "image/oriented.h"
#include "io/images/image_codecs.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
namespace fs = std::filesystem;

namespace {
const fs::path kImages = SVNET_FIXTURES "/pictures";

Image gradient(Index height, Index width) {
  Image image{height, width, {}};
  for (Index i = 0; i < height * width * 3; ++i) image.rgb.push_back(static_cast<std::uint8_t>(i * 31 % 251));
  return image;
}
}  // namespace

TEST_CASE("every kind of image has Pillow's pixels") {
  std::istringstream expected(file_contents(kImages / "expected.txt"));
  int cases = 0;
  std::string name, sha256;
  for (Index height, width; expected >> name >> height >> width >> sha256; ++cases) {
    CAPTURE(name);
    const Image image = read_image(kImages / name);
    CHECK(image.height == height);
    CHECK(image.width == width);
    CHECK(Sha256().update(image.rgb.data(), image.rgb.size()).hex() == sha256);
  }
  CHECK(cases == 22);
}

TEST_CASE("the contents, not the name, decide the format of an image") {
  const TemporaryFolder folder;
  const fs::path path = folder.write("45_90.png", file_contents(kImages / "rgb.jpg"));
  CHECK(read_image(path).rgb == read_image(kImages / "rgb.jpg").rgb);
}

TEST_CASE("bytes after the end of an image do no harm") {
  const TemporaryFolder folder;
  for (const char* name : {"rgb.png", "rgb.jpg", "lossless.webp"}) {
    CAPTURE(name);
    const fs::path path = folder.write(name, file_contents(kImages / name) + "more");
    CHECK(read_image(path).rgb == read_image(kImages / name).rgb);
  }
}

TEST_CASE("a JPEG that is unusual but has all of its pixels is read") {
  const TemporaryFolder folder;
  const auto changed = [&](const char* name, const std::string& before, std::size_t at, const std::string& bytes,
                           std::size_t replaced) {
    std::string file = file_contents(kImages / name);
    const std::size_t place = file.find(before);
    REQUIRE(place != std::string::npos);
    file.replace(place + at, replaced, bytes);
    return read_image(folder.write(name, file)).rgb;
  };
  // Bytes between two segments, a later version of JFIF, and Adobe's marker with a transformation that it does not
  // name.
  CHECK(changed("rgb.jpg", "\xff\xdb", 0, "??", 0) == read_image(kImages / "rgb.jpg").rgb);
  CHECK(changed("rgb.jpg", "JFIF", 5, "\2", 1) == read_image(kImages / "rgb.jpg").rgb);
  CHECK(changed("ycck.jpg", "Adobe", 11, "\7", 1) == read_image(kImages / "ycck.jpg").rgb);
}

TEST_CASE("a written PNG reads back equal, and replaces an older one") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "out.png";
  for (const auto& image : {gradient(1, 1), gradient(7, 300), gradient(64, 5)}) {
    write_png(path, image);
    const Image read = read_image(path);
    CHECK(read.height == image.height);
    CHECK(read.width == image.width);
    CHECK(read.rgb == image.rgb);
  }
}

TEST_CASE("the PNG of a photograph has the same pixels as that of a drawing") {
  for (const auto& [height, width] : {std::pair(1, 1), std::pair(1, 7), std::pair(5, 1), std::pair(67, 33)}) {
    CAPTURE(height, width);
    Image image{height, width, {}};
    for (Index i = 0; i < height * width * 3; ++i) image.rgb.push_back(static_cast<std::uint8_t>(i * i / 7 + 90));
    for (const PngContent content : {PngContent::drawing, PngContent::photograph}) {
      const std::string file = encoded_png("it", image, content);
      const Image back = decode_png("it", {reinterpret_cast<const std::uint8_t*>(file.data()), file.size()});
      CHECK(back.height == height);
      CHECK(back.rgb == image.rgb);
    }
    const std::string grey = encoded_grey_png("it", height, width, std::span(image.rgb).first(height * width));
    const Image back = decode_png("it", {reinterpret_cast<const std::uint8_t*>(grey.data()), grey.size()});
    for (Index i = 0; i < height * width; ++i) CHECK(back.rgb[static_cast<std::size_t>(3 * i)] == image.rgb[i]);
  }
}

TEST_CASE("write_png says why it cannot") {
  const TemporaryFolder folder;
  Image broken = gradient(2, 2);
  broken.rgb.pop_back();
  const fs::path path = folder.path() / "out.png";
  CHECK_THROWS_WITH(write_png(path, broken), path.string() + ": cannot be written: a 2x2x3 image has 11 values");
  CHECK_THROWS_WITH(write_png(path, {0, 2, {}}), path.string() + ": cannot be written: a 0x2x3 image has 0 values");
  CHECK_THROWS_WITH(write_png(path, {2, 0, {}}), path.string() + ": cannot be written: a 2x0x3 image has 0 values");
  CHECK_FALSE(fs::exists(path));
  CHECK_THROWS_WITH(write_png(folder.path() / "none" / "out.png", gradient(2, 2)),
                    Catch::EndsWith("none does not exist; create it first"));
}

TEST_CASE("an image wider than its format allows is not encoded") {
  const std::vector<std::uint8_t> levels(1'000'001);  // libpng's limit is a million
  CHECK_THROWS_WITH(encoded_grey_png("it", 1, 1'000'001, levels), "it: cannot be written: Invalid IHDR data");
  CHECK_THROWS_WITH(encoded_jpeg(gradient(1, 70'000), 90), "[jpeg] an image of 70000x1 pixels cannot be encoded");
}

TEST_CASE("an EXIF orientation is read from JPEG, PNG and WebP, and ignored unless it is to be obeyed") {
  for (const auto& [name, orientation] : {std::pair("turned.jpg", 6),
                                          {"turned.png", 8},
                                          {"turned.webp", 8},
                                          {"rgb.jpg", 1},
                                          {"rgb.png", 1},
                                          {"lossy.webp", 1}}) {
    CAPTURE(name);
    CHECK(read_exif_orientation(kImages / name) == orientation);
    const Image stored = read_image(kImages / name), turned = read_image(kImages / name, ExifOrientation::obey);
    CHECK(turned.rgb == oriented(stored, orientation).rgb);
    CHECK(turned.height == (orientation == 1 ? stored.height : stored.width));
  }
}

TEST_CASE("damaged EXIF data count as none") {
  const TemporaryFolder folder;
  const std::string jpeg = file_contents(kImages / "turned.jpg");
  const auto exif = jpeg.find("Exif");
  REQUIRE(exif != std::string::npos);
  for (std::size_t i = 0; i < 40; ++i)
    for (const char value : {'\0', '\x7f', '\xff'}) {
      std::string damaged = jpeg;
      damaged[exif + i] = value;
      const int orientation = read_exif_orientation(folder.write("d.jpg", damaged));
      CHECK(orientation >= 1);
      CHECK(orientation <= 8);
    }
}

namespace {

/// EXIF data with one entry in its directory, the orientation.
std::string exif(char order, int orientation) {
  const auto number = [&](int value, int size) {
    std::string bytes(static_cast<std::size_t>(size), '\0');
    (order == 'M' ? bytes.back() : bytes.front()) = static_cast<char>(value);
    (order == 'M' ? bytes.end()[-2] : bytes[1]) = static_cast<char>(value >> 8);
    return bytes;
  };
  return std::string(2, order) + number(42, 2) + number(8, 4) + number(1, 2) + number(0x112, 2) + number(3, 2) +
         number(1, 4) + number(orientation, 2) + std::string(6, '\0');
}

std::string jpeg_segment(char kind, const std::string& contents, std::size_t length) {
  return std::string("\xff") + kind + static_cast<char>(length >> 8) + static_cast<char>(length) + contents;
}
std::string jpeg_segment(char kind, const std::string& contents) {
  return jpeg_segment(kind, contents, contents.size() + 2);
}

int orientation_of(const std::string& file) {
  return exif_orientation({reinterpret_cast<const std::uint8_t*>(file.data()), file.size()});
}

}  // namespace

TEST_CASE("EXIF data are read in either byte order, with and without their prefix") {
  const std::string prefix("Exif\0\0", 6);
  for (const char order : {'I', 'M'}) {
    CAPTURE(order);
    const std::string data = exif(order, 6), jpeg = "\xff\xd8" + jpeg_segment('\xe0', "JFIF");
    CHECK(orientation_of(jpeg + jpeg_segment('\xe1', "http") + jpeg_segment('\xe1', prefix + data) + "end") == 6);
    for (const std::string& contents : {data, prefix + data}) {
      std::string webp("RIFF\0\0\0\0WEBPVP8 \1\0\0\0x\0EXIF\0\0\0\0", 30);
      webp[26] = static_cast<char>(contents.size());
      CHECK(orientation_of(webp + contents) == 6);
    }
  }
  CHECK(orientation_of("\xff\xd8" + jpeg_segment('\xe1', prefix + exif('I', 0)) + "end") == 1);
  CHECK(orientation_of("\xff\xd8" + jpeg_segment('\xe1', prefix + exif('I', 9)) + "end") == 1);
  CHECK(orientation_of("\xff\xd8" + jpeg_segment('\xe1', prefix + "XX" + exif('I', 6).substr(2)) + "end") == 1);
  CHECK(orientation_of(exif('I', 6)) == 1);  // a TIFF file, which is not read
}

TEST_CASE("EXIF data behind something damaged count as none") {
  const std::string segment = jpeg_segment('\xe1', std::string("Exif\0\0", 6) + exif('M', 3)) + "end";
  REQUIRE(orientation_of("\xff\xd8" + segment) == 3);
  CHECK(orientation_of("\xff\xd8\xff") == 1);
  CHECK(orientation_of("\xff\xd8" + jpeg_segment('\xe0', "") + "??" + segment) == 1);   // no marker
  CHECK(orientation_of("\xff\xd8" + jpeg_segment('\xe0', "", 0) + segment) == 1);       // shorter than its length
  CHECK(orientation_of("\xff\xd8" + jpeg_segment('\xe0', "", 60'000) + segment) == 1);  // longer than the file
  CHECK(orientation_of("\xff\xd8" + jpeg_segment('\xda', "") + segment) == 1);          // within the pixels
  std::string png = file_contents(kImages / "turned.png");
  REQUIRE(orientation_of(png) == 8);
  png[8] = '\x7f';  // the length of the first chunk
  CHECK(orientation_of(png) == 1);
}

TEST_CASE("the eight orientations are those of Pillow's ImageOps.exif_transpose") {
  Image image{2, 3, {}};
  for (const std::uint8_t level : {0, 1, 2, 10, 11, 12}) image.rgb.insert(image.rgb.end(), 3, level);
  const std::vector<std::vector<int>> expected{{0, 1, 2, 10, 11, 12}, {2, 1, 0, 12, 11, 10}, {12, 11, 10, 2, 1, 0},
                                               {10, 11, 12, 0, 1, 2}, {0, 10, 1, 11, 2, 12}, {10, 0, 11, 1, 12, 2},
                                               {12, 2, 11, 1, 10, 0}, {2, 12, 1, 11, 0, 10}};
  for (int orientation = 1; orientation <= 8; ++orientation) {
    CAPTURE(orientation);
    const Image turned = oriented(image, orientation);
    CHECK(turned.height == (orientation < 5 ? 2 : 3));
    CHECK(turned.width == (orientation < 5 ? 3 : 2));
    std::vector<int> levels;
    for (std::size_t i = 0; i < turned.rgb.size(); i += 3) levels.push_back(turned.rgb[i]);
    CHECK(levels == expected[static_cast<std::size_t>(orientation - 1)]);
  }
}

TEST_CASE("an image comes through a pipe") {
  const TemporaryFolder folder;
  const fs::path pipe = folder.path() / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  std::thread writer([&] { std::ofstream(pipe, std::ios::binary) << file_contents(kImages / "rgb.jpg"); });
  const Image image = read_image(pipe);
  writer.join();
  CHECK(image.rgb == read_image(kImages / "rgb.jpg").rgb);
}
