#include "io/onnx/onnx_windows.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/parallel.h"
#include "nn/kernels/gemm.h"

namespace svnet::io {
namespace {

/// Windows (KH, KW) at strides (SH, SW) of images (N, C, H, W) with zeros at their top and left, and the size (OH, OW)
/// of the result.
struct Window2d {
  Index n, c, h, w, kh, kw, sh, sw, top, left, oh, ow;
};

Window2d window_of(const OnnxOperands& node, Index kh, Index kw) {
  const OnnxTensor& from = node.x();
  if (from.shape.size() != 4) node.refuse("the input is not (N, C, H, W)");
  const auto strides = node.integers("strides", {1, 1}), pads = node.integers("pads", {0, 0, 0, 0});
  Window2d w{from.shape[0], from.shape[1], from.shape[2], from.shape[3], kh, kw,
             strides.at(0), strides.at(1), pads.at(0),    pads.at(1),    0,  0};
  w.oh = (w.h + w.top + pads.at(2) - kh) / w.sh + 1;
  w.ow = (w.w + w.left + pads.at(3) - kw) / w.sw + 1;
  return w;
}

/// (H, W) -> (KH · KW, OH · OW): the pixel under each tap, 0 outside the image.
void gather_taps(const Window2d& w, const float* image, float* to) {
  for (Index i = 0; i < w.kh; ++i)
    for (Index j = 0; j < w.kw; ++j)
      for (Index oh = 0; oh < w.oh; ++oh)
        for (Index ow = 0; ow < w.ow; ++ow) {
          const Index row = oh * w.sh - w.top + i, column = ow * w.sw - w.left + j;
          *to++ = row >= 0 && row < w.h && column >= 0 && column < w.w ? image[row * w.w + column] : 0;
        }
}

}  // namespace

OnnxTensor onnx_convolution(const OnnxOperands& node) {
  const OnnxTensor& kernel = node.x(1);
  const Window2d w = window_of(node, kernel.shape.at(2), kernel.shape.at(3));
  const Index groups = node.integer("group", 1), in = w.c / groups, out = kernel.shape[0] / groups;
  if (in != kernel.shape[1]) node.refuse("channels do not fit");
  const Index taps = w.kh * w.kw, pixels = w.oh * w.ow, depth = in * taps;
  OnnxTensor y = tensor_of({w.n, kernel.shape[0], w.oh, w.ow});
  std::vector<float> columns(static_cast<std::size_t>(depth * pixels));
  for (Index n = 0; n < w.n; ++n)
    for (Index g = 0; g < groups; ++g) {
      const float* image = node.x().values.data() + (n * w.c + g * in) * w.h * w.w;
      Parallel::shared().for_chunks(in, 1, [&](Index channel, Index, int) {
        gather_taps(w, image + channel * w.h * w.w, columns.data() + channel * taps * pixels);
      });
      kernels::gemm<float>(Parallel::shared(), {.m = out, .n = pixels, .k = depth},
                           kernel.values.data() + g * out * depth, columns.data(),
                           y.values.data() + (n * groups + g) * out * pixels);
    }
  if (node.count() < 3) return y;
  const std::vector<float>& bias = node.x(2).values;
  for (std::size_t i = 0; i < y.values.size(); ++i)
    y.values[i] += bias[i / static_cast<std::size_t>(pixels) % bias.size()];
  return y;
}

OnnxTensor onnx_pool(const OnnxOperands& node, OnnxPool kind) {
  const auto kernel = node.integers("kernel_shape", {1, 1});
  const Window2d w = window_of(node, kernel.at(0), kernel.at(1));
  OnnxTensor y = tensor_of({w.n, w.c, w.oh, w.ow});
  Parallel::shared().for_chunks(w.n * w.c, 1, [&](Index plane, Index, int) {
    const float* image = node.x().values.data() + plane * w.h * w.w;
    float* to = y.values.data() + plane * w.oh * w.ow;
    for (Index oh = 0; oh < w.oh; ++oh)
      for (Index ow = 0; ow < w.ow; ++ow) {
        float largest = -std::numeric_limits<float>::infinity(), sum = 0, count = 0;
        for (Index row = std::max<Index>(0, oh * w.sh - w.top); row < std::min(w.h, oh * w.sh - w.top + w.kh); ++row)
          for (Index column = std::max<Index>(0, ow * w.sw - w.left); column < std::min(w.w, ow * w.sw - w.left + w.kw);
               ++column) {
            const float value = image[row * w.w + column];
            largest = std::max(largest, value);
            sum += value;
            count += 1;
          }
        *to++ = kind == OnnxPool::max ? largest : sum / count;
      }
  });
  return y;
}

OnnxTensor onnx_global_pool(const OnnxOperands& node, OnnxPool kind) {
  const OnnxTensor& x = node.x();
  if (x.shape.size() != 4) node.refuse("the input is not (N, C, H, W)");
  OnnxTensor y = tensor_of({x.shape[0], x.shape[1], 1, 1});
  const Index pixels = x.shape[2] * x.shape[3];
  const float* from = x.values.data();
  for (float& value : y.values) {
    value = kind == OnnxPool::max
                ? *std::max_element(from, from + pixels)
                : static_cast<float>(std::accumulate(from, from + pixels, 0.0) / static_cast<double>(pixels));
    from += pixels;
  }
  return y;
}

}  // namespace svnet::io
