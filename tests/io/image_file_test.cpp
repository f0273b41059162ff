#include "io/images/image_file.h"

#include <catch2/catch.hpp>
#include <sstream>

#include "base/sha256.h"
#include "temporary_folder.h"

using namespace svnet;
namespace fs = std::filesystem;

namespace {
const fs::path kPictures = SVNET_FIXTURES "/pictures";

Image gradient(Index height, Index width) {
  Image image{height, width, {}};
  for (Index i = 0; i < height * width * 3; ++i) image.rgb.push_back(static_cast<std::uint8_t>(i * 31 % 251));
  return image;
}
}  // namespace

TEST_CASE("every kind of image has Pillow's pixels") {
  std::istringstream expected(file_contents(kPictures / "expected.txt"));
  int cases = 0;
  std::string name, sha256;
  for (Index height, width; expected >> name >> height >> width >> sha256; ++cases) {
    CAPTURE(name);
    const Image image = read_image(kPictures / name);
    CHECK(image.height == height);
    CHECK(image.width == width);
    CHECK(Sha256().update(image.rgb.data(), image.rgb.size()).hex() == sha256);
  }
  CHECK(cases == 17);
}

TEST_CASE("the contents, not the name, decide the format of an image") {
  const TemporaryFolder folder;
  const fs::path path = folder.write("45_90.png", file_contents(kPictures / "rgb.jpg"));
  CHECK(read_image(path).rgb == read_image(kPictures / "rgb.jpg").rgb);
}

TEST_CASE("bytes after the end of an image do no harm") {
  const TemporaryFolder folder;
  for (const char* name : {"rgb.png", "rgb.jpg", "lossless.webp"}) {
    CAPTURE(name);
    const fs::path path = folder.write(name, file_contents(kPictures / name) + "more");
    CHECK(read_image(path).rgb == read_image(kPictures / name).rgb);
  }
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

TEST_CASE("write_png says why it cannot") {
  const TemporaryFolder folder;
  Image broken = gradient(2, 2);
  broken.rgb.pop_back();
  const fs::path path = folder.path() / "out.png";
  CHECK_THROWS_WITH(write_png(path, broken), path.string() + ": cannot be written: a 2x2x3 image has 11 values");
  CHECK_FALSE(fs::exists(path));
  CHECK_THROWS_WITH(write_png(folder.path() / "none" / "out.png", gradient(2, 2)),
                    Catch::EndsWith("none does not exist; create it first"));
}
