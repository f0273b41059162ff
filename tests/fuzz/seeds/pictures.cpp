// Pictures and depth: tests/fixtures/pictures, and what svnet writes.
#include "io/images/depth_file.h"
#include "io/images/image_codecs.h"
#include "io/images/image_file.h"
#include "seeds.h"

namespace svnet::fuzz {
namespace {

std::string npy(const std::string& type, const std::string& shape, const std::string& values, int version = 1) {
  const std::string text = "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + ", }\n";
  std::string head = "\x93NUMPY";
  head += static_cast<char>(version);
  head += '\0';
  head += static_cast<char>(text.size());
  head.append(version == 1 ? 1 : 3, '\0');
  return head + text + values;
}

void add_depth(const Seeds& seeds) {
  const DepthImage image{2, 3, {0.5f, 0, 1, 2, 0.25f, 3}, 0};
  io::write_depth_png(seeds.path("depth", "millimetres.png"), image);
  seeds.copy("depth", "pictures", "grey16.png");
  seeds.add("depth", "f4", npy("<f4", "(1, 2)", std::string("\0\0\x80\x3f\0\0\0\x3f", 8)));
  seeds.add("depth", "f2", npy(">f2", "(2, 2, 1)", std::string("\x3c\0\x38\0\x7e\0\x04\0", 8), 2));
  seeds.add("depth", "u2", npy("<u2", "(1, 2)", "\x10\x01\xff\xff"));
  seeds.add("depth", "i8", npy("<i8", "(1, 1)", std::string("\x10\x01\0\0\0\0\0\0", 8), 3));
  for (const char* word : {"'descr': '", "'fortran_order': True", "'shape': (", "<f8", ">f4", "<i4", "|u1",
                           "(64000000, 1)", "\x93NUMPY", "9223372036854775807"})
    seeds.add_word("depth", word);
}

}  // namespace

void add_pictures(const Seeds& seeds) {
  for (const char* ending : {".png", ".jpg", ".webp"}) {
    seeds.copy("picture", "pictures", ending);
    seeds.copy("texture", "pictures", ending, "p");
  }
  Image image{3, 2, {}};
  for (int i = 0; i < 18; ++i) image.rgb.push_back(static_cast<std::uint8_t>(13 * i));
  seeds.add("picture", "written.jpg", io::encoded_jpeg(image, 90));
  seeds.add("picture", "written.png", io::encoded_png("seed", image));
  seeds.add("texture", "tga", std::string("t\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x18\0\1\2\3", 22));
  seeds.add("texture", "bmp",
            "p" + std::string("BM\x3a\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\1\0\0\0\1\0\0\0\1\0\x18\0", 30) +
                std::string(24, '\0') + std::string("\1\2\3\0", 4));
  seeds.add("texture", "gif",
            "p" + std::string("GIF89a\1\0\1\0\x80\0\0\xff\xff\xff\0\0\0,\0\0\0\0\1\0\1\0\0\2\2D\1\0;", 35));
  seeds.add(
      "texture", "tiff",
      "p" + std::string("II*\0\x08\0\0\0\x08\0\0\1\3\0\1\0\0\0\1\0\0\0\1\1\3\0\1\0\0\0\1\0\0\0\2\1\3\0\1\0\0\0\x08\0"
                        "\0\0\3\1\3\0\1\0\0\0\1\0\0\0\6\1\3\0\1\0\0\0\1\0\0\0\x11\1\4\0\1\0\0\0\0\0\0\0\x16\1\3\0\1"
                        "\0\0\0\1\0\0\0\x17\1\4\0\1\0\0\0\1\0\0\0\0\0\0\0",
                        110));
  for (const char* word :
       {"IHDR", "IDAT", "PLTE", "tRNS", "eXIf", "iCCP", "\xff\xd8", "\xff\xe1", "\xff\xc0", "\xff\xda", "Exif",
        "II*",  "MM",   "RIFF", "WEBP", "VP8 ", "VP8L", "VP8X",     "ANIM",     "EXIF",     "\x12\x01"})
    for (const char* target : {"picture", "texture"}) seeds.add_word(target, word);
  add_depth(seeds);
}

}  // namespace svnet::fuzz
