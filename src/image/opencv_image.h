#pragma once
#include <opencv2/core.hpp>

#include "image/image.h"

namespace svnet {

/// The pixels of an image as OpenCV's matrix (height, width) of RGB. It shares the image's memory and is valid as long
/// as the image. Only for targets that link OpenCV.
inline cv::Mat3b matrix_of(Image& image) {
  return cv::Mat3b(static_cast<int>(image.height), static_cast<int>(image.width),
                   reinterpret_cast<cv::Vec3b*>(image.rgb.data()));
}

/// The same for an image that must not be written to; OpenCV has no matrix of constant pixels.
inline cv::Mat3b matrix_of(const Image& image) { return matrix_of(const_cast<Image&>(image)); }

}  // namespace svnet
