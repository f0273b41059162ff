#pragma once
#include <opencv2/core.hpp>

namespace svnet::localise {

/// The pixels that differ from the background, and the measures behind the decision.
struct Foreground {
  cv::Mat1f difference;  // of the colours, corrected for a change of the light, in units of their noise
  cv::Mat1f rise_m;      // how much nearer to the camera than before, smoothed; 0: not measured
  cv::Mat1b mask;        // 255 or 0
};

/// Compares an image with one of the background from the same place. Colours are 8-bit RGB; depth is in metres along
/// the camera's axis, 0: not measured.
Foreground find_foreground(const cv::Mat3b& background_rgb, const cv::Mat1f& background_depth_m, const cv::Mat3b& rgb,
                           const cv::Mat1f& depth_m);

}  // namespace svnet::localise
