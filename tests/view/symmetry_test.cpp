#include "view/symmetry.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

using namespace svnet;
using namespace svnet::view;

namespace {

/// The azimuth, in degrees, of the one pixel that is not 0, seen from the image's centre; right is 0, up is 90.
double azimuth_of_mark(Index side, const std::vector<float>& pixels) {
  for (Index i = 0; i < side; ++i)
    for (Index j = 0; j < side; ++j)
      if (pixels[static_cast<std::size_t>((i * side + j) * 3)] != 0) {
        const double right = static_cast<double>(2 * j - (side - 1)), up = static_cast<double>(side - 1 - 2 * i);
        const double degrees = std::atan2(up, right) * 180 / std::numbers::pi;
        return degrees < 0 ? degrees + 360 : degrees;
      }
  return -1;
}

}  // namespace

TEST_CASE("a mark in a top view turns like the azimuth") {
  constexpr Index kSide = 7;
  for (Index row = 0; row < kSide; ++row)
    for (Index column = 0; column < kSide; ++column) {
      if (row == kSide / 2 && column == kSide / 2) continue;
      std::vector<float> image(kSide * kSide * 3);
      for (Index c = 0; c < 3; ++c) image[static_cast<std::size_t>((row * kSide + column) * 3 + c)] = 1;
      const double before = azimuth_of_mark(kSide, image);
      for (int symmetry = 0; symmetry < kSymmetries; ++symmetry) {
        CAPTURE(row, column, symmetry);
        std::vector<float> turned(image.size(), 5);
        apply_symmetry(symmetry, kSide, image.data(), turned.data());
        const double expected = symmetric_theta_deg(symmetry, before);
        CHECK(expected >= 0);
        CHECK(expected < 360);
        CHECK(azimuth_of_mark(kSide, turned) == Approx(expected).margin(1e-9));
      }
    }
}

TEST_CASE("all orientations differ, and the first is the image as taken") {
  std::vector<float> image(3 * 3 * 3);
  for (std::size_t i = 0; i < image.size(); ++i) image[i] = static_cast<float>(i + 1);
  std::set<std::vector<float>> seen;
  for (int symmetry = 0; symmetry < kSymmetries; ++symmetry) {
    std::vector<float> turned(image.size());
    apply_symmetry(symmetry, 3, image.data(), turned.data());
    if (symmetry == 0) CHECK(turned == image);
    seen.insert(turned);
  }
  CHECK(seen.size() == kSymmetries);
}
