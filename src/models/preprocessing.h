#pragma once
#include <cstdint>
#include <string_view>

#include "base/enum_names.h"
#include "image/image.h"
#include "image/resize.h"

namespace svnet::models {

/// How pixels become network input: the modes of Keras' imagenet_utils.preprocess_input, with its bits.
///   none   the 8-bit values unchanged, RGB
///   caffe  BGR, minus the ImageNet means 103.939, 116.779, 123.68 (VGG)
///   tf     x / 127.5 - 1, RGB (Xception, MobileNet)
enum class PixelMode { none, caffe, tf };

constexpr auto enum_table(PixelMode) {
  return std::to_array<EnumName<PixelMode>>(
      {{PixelMode::none, "none"}, {PixelMode::caffe, "caffe"}, {PixelMode::tf, "tf"}});
}

/// Throws Error for an unknown name.
PixelMode pixel_mode_named(std::string_view name);

/// What a model file says about the model's input.
struct Preprocessing {
  PixelMode mode = PixelMode::none;
  Index height = 224;
  Index width = 224;
  Interpolation interpolation = Interpolation::bilinear;

  /// Number of floats of one prepared image.
  Index size() const { return height * width * 3; }
};

/// rgb (pixels, 3) -> out (pixels, 3).
void preprocess(PixelMode, const std::uint8_t* rgb, Index pixels, float* out);

/// Resizes to (height, width) if needed and preprocesses; out is (height, width, 3).
void prepare(const Preprocessing&, const Image&, float* out);
/// The same with buffers that the caller keeps.
void prepare(const Preprocessing&, const Image&, float* out, ResizeBuffers& buffers);

}  // namespace svnet::models
