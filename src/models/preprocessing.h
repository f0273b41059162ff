#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "image/image.h"
#include "image/resize.h"

namespace svnet {

/// How pixels become network input: the modes of Keras' imagenet_utils.preprocess_input, with its bits.
///   none   the grey levels as they are, RGB
///   caffe  BGR, less the ImageNet means 103.939, 116.779, 123.68 (VGG)
///   tf     x / 127.5 - 1, RGB (Xception, MobileNet)
enum class PixelMode { none, caffe, tf };

/// As files name them. pixel_mode_named throws Error for an unknown name.
std::string name_of(PixelMode);
PixelMode pixel_mode_named(std::string_view name);

/// All that a model's file says about its input.
struct Preprocessing {
  PixelMode mode = PixelMode::none;
  Index height = 224;
  Index width = 224;
  Interpolation interpolation = Interpolation::bilinear;

  /// Number of floats of one prepared image.
  Index size() const { return height * width * 3; }
};

/// rgb (pixels, 3) grey levels -> out (pixels, 3).
void preprocess(PixelMode, const std::uint8_t* rgb, Index pixels, float* out);

/// Resizes to (height, width) where needed and preprocesses; out is (height, width, 3).
void prepare(const Preprocessing&, const Image&, float* out);

}  // namespace svnet
