#include "localise/foreground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace svnet::localise {
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

/// The change of the light per channel: the median ratio, on which an object has little influence if it covers less
/// than half of the image.
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

/// The mean depth over 9x9 pixels. Pixels that were not measured or lie beyond a step in depth do not count.
cv::Mat1f smooth_depth(const cv::Mat1f& depth) {
  constexpr int kReach = 4;
  constexpr float kStep_m = 0.008f;
  const cv::Size window(2 * kReach + 1, 2 * kReach + 1);
  cv::Mat1f middle, sums, counts, smooth(depth.size(), 0);
  cv::medianBlur(depth, middle, 5);
  cv::boxFilter(depth, sums, CV_32F, window, {-1, -1}, false, cv::BORDER_REPLICATE);
  cv::boxFilter(cv::Mat1f((depth > 0) / 255), counts, CV_32F, window, {-1, -1}, false, cv::BORDER_REPLICATE);
  for (int y = 0; y < depth.rows; ++y)
    for (int x = 0; x < depth.cols; ++x) {
      smooth(y, x) = counts(y, x) > 0 ? sums(y, x) / counts(y, x) : 0;
      if (std::abs(smooth(y, x) - middle(y, x)) < kStep_m / 8) continue;  // no step here
      float sum = 0, count = 0;
      for (int ny = std::max(0, y - kReach); ny <= std::min(depth.rows - 1, y + kReach); ++ny)
        for (int nx = std::max(0, x - kReach); nx <= std::min(depth.cols - 1, x + kReach); ++nx)
          if (depth(ny, nx) > 0 && std::abs(depth(ny, nx) - middle(y, x)) < kStep_m) sum += depth(ny, nx), ++count;
      smooth(y, x) = count > 0 ? sum / count : middle(y, x);
    }
  return smooth;
}

/// The rise of each pixel that both images measured, or NaN.
cv::Mat1f measured_rise(const cv::Mat1f& before, const cv::Mat1f& after) {
  const cv::Mat1f table = smooth_depth(before);
  cv::Mat1f rise(before.size(), std::numeric_limits<float>::quiet_NaN());
  for (int y = 0; y < rise.rows; ++y)
    for (int x = 0; x < rise.cols; ++x)
      if (table(y, x) > 0 && after(y, x) > 0) rise(y, x) = table(y, x) - after(y, x);
  return rise;
}

/// The rise averaged over those of the 9x9 pixels that have the pixel's own colour, up to noise, so that it is smoothed
/// along a thin part or a shadow but not across its edge. For a pixel that was not measured, its neighbours vote
/// whether it rose, and the mean of the majority is taken. `light` is the square root of linear light. The result is 0
/// if nothing was measured nearby, or if neither colour (`difference`) nor depth changed.
cv::Mat1f smooth_rise(const cv::Mat1f& rise, const cv::Mat3f& light, const cv::Mat1f& difference, float noise) {
  constexpr int kReach = 4;
  constexpr float kSameDifference = 3, kSameRise_m = 0.001f;
  cv::Mat1f nearby = rise.clone();
  cv::patchNaNs(nearby, 0);
  cv::blur(nearby, nearby, {5, 5});
  constexpr float kStep_m = 0.005f;
  const float sharpness = 1 / (2 * 16 * noise * noise);
  cv::Mat1f smooth(rise.size(), 0);
  for (int y = 0; y < rise.rows; ++y)
    for (int x = 0; x < rise.cols; ++x) {
      if (difference(y, x) < kSameDifference && std::abs(nearby(y, x)) < kSameRise_m) continue;
      const float own = rise(y, x);
      std::array<float, 2> sum{}, count{};
      for (int ny = std::max(0, y - kReach); ny <= std::min(rise.rows - 1, y + kReach); ++ny)
        for (int nx = std::max(0, x - kReach); nx <= std::min(rise.cols - 1, x + kReach); ++nx) {
          const float value = rise(ny, nx);
          if (std::isnan(value) || std::abs(value - own) > kStep_m) continue;
          const cv::Vec3f step = light(ny, nx) - light(y, x);
          const float distance = step.dot(step) * sharpness;
          const float weight = 1 / (1 + distance * distance);
          const std::size_t party = std::isnan(own) && value > kStep_m ? 1 : 0;
          sum[party] += weight * value, count[party] += weight;
        }
      const std::size_t party = count[1] > count[0] ? 1 : 0;
      if (count[party] > 0) smooth(y, x) = sum[party] / count[party];
    }
  return smooth;
}

/// The connected patches of `likely` pixels with enough `sure` pixels in them. A blade seen on edge is one pixel wide,
/// and the camera measures the depth of few of its pixels: `measured` pixels near each other therefore count together
/// even if their patches do not touch.
cv::Mat1b without_specks(const cv::Mat1b& likely, const cv::Mat1b& sure, const cv::Mat1b& measured) {
  constexpr int kLeastSure_px = 8, kLeast_px = 12, kGap_px = 16;
  cv::Mat patches, groups;
  cv::Mat1b joined;
  cv::dilate(measured, joined, cv::getStructuringElement(cv::MORPH_ELLIPSE, {kGap_px + 1, kGap_px + 1}));
  const auto patch_count = static_cast<std::size_t>(cv::connectedComponents(likely, patches, 8));
  const auto group_count = static_cast<std::size_t>(cv::connectedComponents(joined, groups, 8));
  std::vector<int> area(patch_count, 0), sure_pixels(patch_count, 0), measured_pixels(group_count, 0);
  const auto at = [](const cv::Mat& labels, int y, int x) { return static_cast<std::size_t>(labels.at<int>(y, x)); };
  const auto each_likely = [&](const auto& body) {
    for (int y = 0; y < likely.rows; ++y)
      for (int x = 0; x < likely.cols; ++x)
        if (likely(y, x) != 0) body(y, x);
  };
  each_likely([&](int y, int x) {
    ++area[at(patches, y, x)];
    if (sure(y, x) != 0) ++sure_pixels[at(patches, y, x)];
    if (measured(y, x) != 0) ++measured_pixels[at(groups, y, x)];
  });
  std::vector<bool> kept(patch_count);
  for (std::size_t i = 0; i < patch_count; ++i) kept[i] = area[i] >= kLeast_px && sure_pixels[i] >= kLeastSure_px;
  each_likely([&](int y, int x) {
    if (measured(y, x) != 0 && measured_pixels[at(groups, y, x)] >= kLeastSure_px) kept[at(patches, y, x)] = true;
  });
  cv::Mat1b mask(likely.size(), 0);
  each_likely([&](int y, int x) { mask(y, x) = kept[at(patches, y, x)] ? 255 : 0; });
  return mask;
}

}  // namespace

Foreground find_foreground(const cv::Mat3b& background_rgb, const cv::Mat1f& background_depth_m, const cv::Mat3b& rgb,
                           const cv::Mat1f& depth_m) {
  constexpr float kSureDifference = 6, kLeastDifference = 3.5f, kSureRise_m = 0.004f, kLeastRise_m = 0.002f;
  constexpr float kSureMeasured_m = 0.008f;  // by a single pixel
  constexpr float kShadowRise_m = 0.0012f, kShadowDarkest = 0.12f, kShadowTint = 1.35f;
  constexpr double kSigma_px = 0.6;
  const cv::Mat3f before = linear(background_rgb, kSigma_px), after = linear(rgb, kSigma_px);
  const cv::Vec3f change = light_change(before, after);
  Foreground result;

  // Shot noise grows with the root of the light: differences of roots have one size everywhere.
  result.difference.create(rgb.size());
  cv::Mat3f roots(rgb.size());
  std::vector<float> sample;
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x) {
      float sum = 0;
      for (int c = 0; c < 3; ++c) {
        roots(y, x)[c] = std::sqrt(after(y, x)[c] / change[c]);
        const float step = roots(y, x)[c] - std::sqrt(before(y, x)[c]);
        sum += step * step;
      }
      result.difference(y, x) = std::sqrt(sum);
      if (x % 3 == 0 && y % 3 == 0) sample.push_back(result.difference(y, x));
    }
  const float noise = std::max(median(sample) / 1.54f, 0.002f);  // the median of the root of χ² of three is 1.54 σ
  result.difference /= noise;
  const cv::Mat1f rise_m = measured_rise(background_depth_m, depth_m);
  result.rise_m = smooth_rise(rise_m, roots, result.difference, noise);

  // A blurred edge is where half of the step is reached: fainter pixels beside stronger ones are its skirt.
  constexpr float kSkirt = 0.4f;
  cv::Mat1f strongest;
  cv::dilate(result.difference, strongest, cv::Mat1b::ones(3, 3));

  // What is sure, and what is likely where it touches that.
  cv::Mat1b likely(rgb.size(), 0), sure(rgb.size(), 0), measured(rgb.size(), 0);
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x) {
      const float rise = result.rise_m(y, x), difference = result.difference(y, x);
      bool differs = difference > std::max(kLeastDifference, kSkirt * strongest(y, x));
      if (differs && rise < kShadowRise_m) {
        float least = 1e9f, most = 0;
        for (int c = 0; c < 3; ++c) {
          const float ratio = (after(y, x)[c] + 2e-3f) / (change[c] * (before(y, x)[c] + 2e-3f));
          least = std::min(least, ratio);
          most = std::max(most, ratio);
        }
        differs = !(most < 1.1f && least > kShadowDarkest && most < kShadowTint * least);
      }
      if (differs || rise > kLeastRise_m) likely(y, x) = 255;
      if (rise_m(y, x) > kSureMeasured_m) measured(y, x) = 255;
      if ((differs && difference > kSureDifference) || rise > kSureRise_m || measured(y, x) != 0)
        likely(y, x) = sure(y, x) = 255;
    }
  result.mask = without_specks(likely, sure, measured);
  return result;
}

}  // namespace svnet::localise
