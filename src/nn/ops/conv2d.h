#pragma once
#include "nn/kernels/convolution_choice.h"
#include "nn/kernels/window.h"
#include "nn/tensor.h"

namespace svnet::ops {

struct ConvOptions {
  Index stride_h = 1, stride_w = 1;
  Padding padding{};
  kernels::Convolution convolution = kernels::Convolution::automatic;
};

/// x (N, H, W, C) * w (KH, KW, C, K) -> (N, OH, OW, K). In f32, 3×3 windows of stride 1 use Winograd forwards and
/// backwards, unless options.convolution is direct.
Tensor conv2d(const Tensor& x, const Tensor& w, const ConvOptions& options);

/// x (N, H, W, C), w (KH, KW, C, M) -> (N, OH, OW, C·M), output channel c·M + m from input channel c.
Tensor depthwise_conv2d(const Tensor& x, const Tensor& w, const ConvOptions& options);

/// Depthwise convolution, then a 1×1 convolution: depthwise (KH, KW, C, M), pointwise (1, 1, C·M, K).
Tensor separable_conv2d(const Tensor& x, const Tensor& depthwise, const Tensor& pointwise, const ConvOptions& options);

}  // namespace svnet::ops
