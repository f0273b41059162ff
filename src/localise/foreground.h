#pragma once
#include <opencv2/core.hpp>

namespace svnet {

/// What stands out from the background, and why.
struct Foreground {
  cv::Mat1f difference;  // of the colours, after the light's change, in units of their noise
  cv::Mat1f rise_m;      // how much nearer than before, smoothed; 0 where unknown
  cv::Mat1b mask;        // 255 or 0
};

/// rgb: 8-bit; depth: metres along the camera's axis, 0 where unknown.
Foreground find_foreground(const cv::Mat3b& background_rgb, const cv::Mat1f& background_depth_m, const cv::Mat3b& rgb,
                           const cv::Mat1f& depth_m);

}  // namespace svnet
