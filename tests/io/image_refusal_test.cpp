#include <catch2/catch.hpp>
#include <cstdio>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "io/images/image_codecs.h"
#include "io/images/image_file.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
namespace fs = std::filesystem;

namespace {
const fs::path kImages = SVNET_FIXTURES "/pictures";

/// The error message of read_image without the path at its start; "" if it succeeds.
std::string refusal(const fs::path& path) {
  try {
    read_image(path);
  } catch (const Error& error) {
    const std::string message = error.what(), start = path.string() + ": ";
    INFO(message);
    REQUIRE(message.substr(0, start.size()) == start);
    REQUIRE(message.find('\n') == std::string::npos);
    return message.substr(start.size());
  }
  return "";
}

/// Redirects stderr to a file while this object exists.
class CapturedStderr {
 public:
  explicit CapturedStderr(const fs::path& path) : before_(::dup(2)) {
    const int file = ::open(path.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
    ::dup2(file, 2);
    ::close(file);
  }
  ~CapturedStderr() {
    std::fflush(stderr);
    ::dup2(before_, 2);
    ::close(before_);
  }

 private:
  int before_;
};
}  // namespace

TEST_CASE("files that are not images are refused with a reason") {
  const TemporaryFolder folder;
  CHECK(refusal(folder.path() / "none.png") == "no such file");
  CHECK(refusal(folder.path()) == "is a folder, expected an image (PNG, JPEG or WebP)");
  CHECK(refusal("/dev/null") == "is not a regular file, expected an image");
  CHECK(refusal(folder.write("empty.png", "")) == "is empty, expected an image (PNG, JPEG or WebP)");
  CHECK(refusal(folder.write("notes.png", "not an image\n")) ==
        "is not a PNG, JPEG or WebP image, whatever its name says");
  CHECK(refusal(folder.write("lfs.png", "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\n")) ==
        "is not a PNG, JPEG or WebP image, but a Git LFS pointer; get the file itself by 'git lfs pull'");
  CHECK_THAT(refusal(folder.write("page.jpg", "<!DOCTYPE html><html>")),
             Catch::StartsWith("is not a PNG, JPEG or WebP image, but a web page (HTML), as a failed download"));
  CHECK_THAT(refusal(folder.write("phone.jpg", std::string("\0\0\0\x18"
                                                           "ftypheic\0\0\0\0",
                                                           16))),
             Catch::Contains("but an HEIC or AVIF image"));
  CHECK(refusal(kImages / "animated.webp") == "is an animated WebP, expected a single image");
}

TEST_CASE("an image that may not be read is refused with the system's reason") {
  if (::geteuid() == 0) {
    WARN("skipped: root may read everything");
    return;
  }
  const TemporaryFolder folder;
  const fs::path path = folder.write("a.png", "x");
  fs::permissions(path, fs::perms::none);
  CHECK(refusal(path) == "cannot be read: Permission denied");
}

TEST_CASE("an image truncated anywhere is refused, and nothing is printed") {
  const TemporaryFolder folder;
  const fs::path noise = folder.path() / "stderr.txt";
  for (const char* name : {"rgb.png", "palette.png", "rgb16.png", "rgb.jpg", "progressive.jpg", "grey.jpg",
                           "lossy.webp", "lossless.webp", "alpha.webp"}) {
    CAPTURE(name);
    const std::string whole = file_contents(kImages / name);
    std::size_t read = 0;
    {
      const CapturedStderr captured(noise);
      for (std::size_t size = 0; size < whole.size(); ++size)
        read += refusal(folder.write("cut", std::string_view(whole).substr(0, size))).empty();
    }
    CHECK(read == 0);
    CHECK(file_contents(noise).empty());
  }
}

TEST_CASE("a truncated image is named as truncated") {
  const TemporaryFolder folder;
  const auto cut = [&](const char* name, std::size_t bytes) {
    const std::string whole = file_contents(kImages / name);
    return refusal(folder.write(name, std::string_view(whole).substr(0, whole.size() - bytes)));
  };
  CHECK(cut("rgb.jpg", 2) == "is a damaged or incomplete JPEG image (Premature end of JPEG file); replace the file");
  CHECK(cut("rgb.png", 5) == "is a damaged or incomplete PNG image (the file ends too early); replace the file");
  CHECK(cut("lossy.webp", 5) == "is a damaged or incomplete WebP image (it has 195 bytes of 200); replace the file");
}

TEST_CASE("a PNG with any changed byte of its pixels is refused") {
  const TemporaryFolder folder;
  const std::string whole = file_contents(kImages / "rgb.png");
  const std::size_t start = whole.find("IDAT"), end = whole.find("IEND") - 4;
  REQUIRE(end < whole.size());
  for (std::size_t i = start; i < end; ++i) {
    std::string damaged = whole;
    damaged[i] ^= 0x20;
    CAPTURE(i);
    CHECK_THAT(refusal(folder.write("a.png", damaged)), Catch::StartsWith("is a damaged or incomplete PNG image ("));
  }
}

TEST_CASE("a JPEG whose entropy-coded data is broken is refused") {
  const TemporaryFolder folder;
  const std::string whole = file_contents(kImages / "rgb.jpg");
  const std::string joined_ends = whole.substr(0, whole.size() - 60) + whole.substr(whole.size() - 2);
  CHECK(refusal(folder.write("a.jpg", joined_ends)) ==
        "is a damaged or incomplete JPEG image (Corrupt JPEG data: premature end of data segment); replace the file");
}

TEST_CASE("an image too large is refused by its header alone") {
  const TemporaryFolder folder;
  // Only headers: 20000 columns of 20000 rows.
  const std::string png(
      "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x4e\x20\0\0\x4e\x20\x08\2\0\0\0\x6c\x12\xd1\x6e\0\0\0\0IDAT\x35\xaf\x06\x1e",
      45);
  CHECK(refusal(folder.write("a.png", png)) ==
        "has 20000x20000 pixels, more than the 64 megapixels that are read; make it smaller");
  std::string jpeg = file_contents(kImages / "grey.jpg");
  const std::size_t frame = jpeg.find("\xff\xc0");
  REQUIRE(frame != std::string::npos);
  jpeg.replace(frame + 5, 4, "\x4e\x20\x4e\x20");
  CHECK(refusal(folder.write("a.jpg", jpeg)) ==
        "has 20000x20000 pixels, more than the 64 megapixels that are read; make it smaller");
}

TEST_CASE("a JPEG of two colour channels is refused") {
  const TemporaryFolder folder;
  const std::string frame("\xff\xc0\0\x0e\x08\0\1\0\1\2\1\x11\0\2\x11\0", 16);
  const std::string scan("\xff\xda\0\x0a\2\1\0\2\0\0\x3f\0", 12);
  CHECK(refusal(folder.write("a.jpg", "\xff\xd8" + frame + scan)) ==
        "is a JPEG image with 2 colour channels, expected 1 (grey), 3 or 4 (CMYK); convert it to RGB");
}

TEST_CASE("a WebP whose header or pixels are damaged is refused") {
  const TemporaryFolder folder;
  std::string header = file_contents(kImages / "lossy.webp"), pixels = file_contents(kImages / "lossless.webp");
  header.replace(12, 4, "????");
  CHECK(refusal(folder.write("a.webp", header)) ==
        "is a damaged or incomplete WebP image (its header cannot be read); replace the file");
  pixels.replace(30, pixels.size() - 30, pixels.size() - 30, '\xff');
  CHECK(refusal(folder.write("a.webp", pixels)) ==
        "is a damaged or incomplete WebP image (its pixels cannot be decoded); replace the file");
}

TEST_CASE("a codec that lacks memory does not call the file damaged") {
  for (const char* reason : {"Insufficient memory (case 4)", "Out of memory", "outofmem"})
    CHECK_THROWS_AS(fail_damaged("a.jpg", "JPEG", reason), std::bad_alloc);
}
