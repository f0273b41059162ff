#include "predict/prediction_picture.h"

#include <catch2/catch.hpp>

#include "base/error.h"
#include "frame/top_view.h"
#include "predict/half_sphere_plot.h"
#include "view/pose_grid.h"

using namespace svnet;
using namespace svnet::predict;

namespace {

std::vector<float> rising_scores(std::size_t count) {
  std::vector<float> scores;
  for (std::size_t i = 0; i < count; ++i) scores.push_back(0.1f * static_cast<float>(i));
  return scores;
}

/// The part of an image from a corner on.
Image part(const Image& image, Index top, Index left, Index height, Index width) {
  Image result{height, width, {}};
  for (Index y = top; y < top + height; ++y) {
    const auto row = image.rgb.begin() + 3 * (y * image.width + left);
    result.rgb.insert(result.rgb.end(), row, row + 3 * width);
  }
  return result;
}

}  // namespace

TEST_CASE("a prediction's picture has the top image, and the half-sphere as it lies in that image") {
  const Image top = frame::picture_of(frame::wedge(1.4, 0.4, 30), {.height = 512, .width = 512});
  const auto poses = view::paper_grid();
  const auto scores = rising_scores(poses.size());
  const Image picture = prediction_picture(top, nullptr, poses, scores);
  REQUIRE(picture.height == 624);
  REQUIRE(picture.width == 1232);
  CHECK(part(picture, 56, 24, 20, 20).rgb == part(top, 0, 0, 20, 20).rgb);
  const auto half_turned = [](const Image& image) { return frame::quarter_turned(frame::quarter_turned(image)); };
  const Image plot = half_sphere_plot(poses, scores);
  CHECK(part(picture, 56 + 240, 568 + 240, 32, 32).rgb == half_turned(part(plot, 240, 240, 32, 32)).rgb);
  // The axis is drawn over the object's middle.
  CHECK(part(picture, 56 + 206, 24 + 206, 100, 100).rgb != part(top, 206, 206, 100, 100).rgb);
}

TEST_CASE("a picture can be drawn of any image and of one pose, but not of no image") {
  const view::CameraPose pose[] = {{0, 45}};
  const float score[] = {0.5f};
  CHECK(prediction_picture(Image{3, 200, std::vector<std::uint8_t>(1800, 9)}, nullptr, pose, score).width == 1232);
  CHECK_THROWS_AS(prediction_picture(Image{}, nullptr, pose, score), Error);
}
