#include "models/preprocessing.h"

#include "base/text.h"

namespace svnet::models {

PixelMode pixel_mode_named(std::string_view name) {
  if (const auto mode = find_enum<PixelMode>(std::string(name))) return *mode;
  fail("preprocessing '", name, "' is not known", suggestion(name, names_of<PixelMode>()));
}

void preprocess(PixelMode mode, const std::uint8_t* rgb, Index pixels, float* out) {
  switch (mode) {
    case PixelMode::none:
      for (Index i = 0; i < 3 * pixels; ++i) out[i] = rgb[i];
      break;
    case PixelMode::caffe:
      for (Index i = 0; i < 3 * pixels; i += 3) {
        out[i] = static_cast<float>(rgb[i + 2]) - 103.939f;
        out[i + 1] = static_cast<float>(rgb[i + 1]) - 116.779f;
        out[i + 2] = static_cast<float>(rgb[i]) - 123.68f;
      }
      break;
    case PixelMode::tf:
      for (Index i = 0; i < 3 * pixels; ++i) out[i] = static_cast<float>(rgb[i]) / 127.5f - 1.0f;
      break;
  }
}

void prepare(const Preprocessing& preprocessing, const Image& image, float* out) {
  ResizeBuffers buffers;
  prepare(preprocessing, image, out, buffers);
}

void prepare(const Preprocessing& preprocessing, const Image& image, float* out, ResizeBuffers& buffers) {
  const Index pixels = preprocessing.height * preprocessing.width;
  if (image.height == preprocessing.height && image.width == preprocessing.width)
    return preprocess(preprocessing.mode, image.rgb.data(), pixels, out);
  const Image& small = resized(image, preprocessing.height, preprocessing.width, preprocessing.interpolation, buffers);
  preprocess(preprocessing.mode, small.rgb.data(), pixels, out);
}

}  // namespace svnet::models
