#include "models/preprocessing.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "base/sha256.h"

using namespace svnet;
using namespace svnet::models;

TEST_CASE("preprocess gives Keras' bits for every grey level") {
  std::vector<std::uint8_t> rgb;
  for (int i = 0; i < 256; ++i)
    for (const int value : {i, 255 - i, 7 * i % 256}) rgb.push_back(static_cast<std::uint8_t>(value));
  std::ifstream fixtures(SVNET_FIXTURES "/image.txt");
  REQUIRE(fixtures);
  int cases = 0;
  for (std::string line; std::getline(fixtures, line);) {
    std::istringstream words(line);
    std::string kind, mode, sha256;
    words >> kind >> mode >> sha256;
    if (kind != "preprocess") continue;
    CAPTURE(line);
    std::vector<float> out(rgb.size());
    preprocess(pixel_mode_named(mode), rgb.data(), 256, out.data());
    CHECK(Sha256().update(out.data(), out.size() * sizeof(float)).hex() == sha256);
    ++cases;
  }
  CHECK(cases == 3);
}

TEST_CASE("the modes follow their definitions") {
  const std::uint8_t rgb[] = {255, 51, 0};
  float out[3];
  preprocess(PixelMode::none, rgb, 1, out);
  CHECK((out[0] == 255.0f && out[1] == 51.0f && out[2] == 0.0f));
  preprocess(PixelMode::caffe, rgb, 1, out);
  CHECK((out[0] == 0 - 103.939f && out[1] == 51 - 116.779f && out[2] == 255 - 123.68f));
  preprocess(PixelMode::tf, rgb, 1, out);
  CHECK((out[0] == 1.0f && out[1] == Approx(-0.6) && out[2] == -1.0f));
}

TEST_CASE("prepare resizes if the size differs") {
  const Image image{1, 2, {10, 20, 30, 40, 50, 60}};
  Preprocessing same{PixelMode::none, 1, 2, Interpolation::nearest};
  std::vector<float> out(same.size());
  prepare(same, image, out.data());
  CHECK(out == std::vector<float>{10, 20, 30, 40, 50, 60});
  const Preprocessing larger{PixelMode::none, 2, 3, Interpolation::bilinear};
  out.assign(larger.size(), -1);
  prepare(larger, image, out.data());
  CHECK(out == std::vector<float>{10, 20, 30, 25, 35, 45, 40, 50, 60, 10, 20, 30, 25, 35, 45, 40, 50, 60});
}

TEST_CASE("pixel modes have names") {
  for (const PixelMode mode : {PixelMode::none, PixelMode::caffe, PixelMode::tf})
    CHECK(pixel_mode_named(name_of(mode)) == mode);
  CHECK_THROWS_WITH(pixel_mode_named("torch"), "preprocessing 'torch' is not known; known: none, caffe, tf");
}
