#include "foreground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace svnet {
namespace {

float median(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Linear light, blurred by a Gaussian of `sigma` pixels.
cv::Mat3f linear(const cv::Mat3b& rgb, double sigma) {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = std::pow((static_cast<float>(i) + 0.5f) / 255.5f, 2.2f);
  cv::Mat3f light(rgb.size());
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x)
      for (int c = 0; c < 3; ++c) light(y, x)[c] = table[rgb(y, x)[c]];
  if (sigma > 0) cv::GaussianBlur(light, light, cv::Size(), sigma);
  return light;
}

/// How the light changed, per channel: the median ratio, which an object that covers less than half does not move.
cv::Vec3f light_change(const cv::Mat3f& before, const cv::Mat3f& after) {
  cv::Vec3f change;
  for (int c = 0; c < 3; ++c) {
    std::vector<float> ratios;
    for (int y = 0; y < before.rows; y += 3)
      for (int x = 0; x < before.cols; x += 3) ratios.push_back((after(y, x)[c] + 1e-3f) / (before(y, x)[c] + 1e-3f));
    change[c] = median(ratios);
  }
  return change;
}

/// The mean rise over 5x5 pixels that both pictures measured, without those on the other side of a step.
cv::Mat1f smooth_rise(const cv::Mat1f& before, const cv::Mat1f& after) {
  cv::Mat1f rise(before.size(), 0);
  for (int y = 0; y < rise.rows; ++y)
    for (int x = 0; x < rise.cols; ++x)
      if (before(y, x) > 0 && after(y, x) > 0) rise(y, x) = before(y, x) - after(y, x);
  cv::Mat1f middle;
  cv::medianBlur(rise, middle, 3);
  cv::Mat1f smooth(rise.size(), 0);
  for (int y = 2; y < rise.rows - 2; ++y)
    for (int x = 2; x < rise.cols - 2; ++x) {
      float sum = 0, count = 0;
      for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx)
          if (before(y + dy, x + dx) > 0 && after(y + dy, x + dx) > 0 &&
              std::abs(rise(y + dy, x + dx) - middle(y, x)) < 0.008f)
            sum += rise(y + dy, x + dx), ++count;
      smooth(y, x) = count > 0 ? sum / count : middle(y, x);
    }
  return smooth;
}

}  // namespace

Foreground find_foreground(const cv::Mat3b& background_rgb, const cv::Mat1f& background_depth_m, const cv::Mat3b& rgb,
                           const cv::Mat1f& depth_m) {
  constexpr float kLeastDifference = 6, kRise_m = 0.004f, kShadowRise_m = 0.0014f;
  constexpr float kShadowDarkest = 0.12f, kShadowTint = 1.35f;
  constexpr double kSigma_px = 0.6;
  const cv::Mat3f before = linear(background_rgb, kSigma_px), after = linear(rgb, kSigma_px);
  const cv::Vec3f change = light_change(before, after);
  Foreground result;
  result.rise_m = smooth_rise(background_depth_m, depth_m);

  // Shot noise grows with the root of the light: differences of roots have one size everywhere.
  result.difference.create(rgb.size());
  std::vector<float> sample;
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x) {
      float sum = 0;
      for (int c = 0; c < 3; ++c) {
        const float step = std::sqrt(after(y, x)[c] / change[c]) - std::sqrt(before(y, x)[c]);
        sum += step * step;
      }
      result.difference(y, x) = std::sqrt(sum);
      if (x % 3 == 0 && y % 3 == 0) sample.push_back(result.difference(y, x));
    }
  const float noise = std::max(median(sample) / 1.54f, 0.002f);  // the median of the root of χ² of three is 1.54 σ
  result.difference /= noise;

  // A blurred edge is where half of the step is reached: fainter pixels beside stronger ones are its skirt.
  constexpr float kSkirt = 0.4f;
  cv::Mat1f strongest;
  cv::dilate(result.difference, strongest, cv::Mat1b::ones(3, 3));

  result.mask = cv::Mat1b(rgb.size(), 0);
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x) {
      const float rise = result.rise_m(y, x);
      bool object = result.difference(y, x) > std::max(kLeastDifference, kSkirt * strongest(y, x));
      if (object && rise < kShadowRise_m) {
        float least = 1e9f, most = 0;
        for (int c = 0; c < 3; ++c) {
          const float ratio = (after(y, x)[c] + 2e-3f) / (change[c] * (before(y, x)[c] + 2e-3f));
          least = std::min(least, ratio);
          most = std::max(most, ratio);
        }
        object = !(most < 1.1f && least > kShadowDarkest && most < kShadowTint * least);
      }
      if (object || rise > kRise_m) result.mask(y, x) = 255;
    }
  return result;
}

}  // namespace svnet
