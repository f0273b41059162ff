#pragma once
#include "nn/kernels/epilogue.h"
#include "nn/kernels/window.h"
#include "nn/tensor.h"

namespace svnet::ops {

struct ConvOptions {
  Index stride_h = 1, stride_w = 1;
  Padding padding{};
};

/// x (N, H, W, C) * w (KH, KW, C, K) -> (N, OH, OW, K).
Tensor conv2d(const Tensor& x, const Tensor& w, const ConvOptions& options);

/// x (N, H, W, C), w (KH, KW, C, M) -> (N, OH, OW, C·M), output channel c·M + m from input channel c.
Tensor depthwise_conv2d(const Tensor& x, const Tensor& w, const ConvOptions& options);

/// Depthwise convolution, then a 1×1 convolution: depthwise (KH, KW, C, M), pointwise (1, 1, C·M, K).
Tensor separable_conv2d(const Tensor& x, const Tensor& depthwise, const Tensor& pointwise, const ConvOptions& options);

/// What an inference convolution does to its output (…, K) in the same pass: clamp(y + bias), bias (K) or empty.
struct ConvEpilogue {
  Tensor bias;
  kernels::Clamp clamp = kernels::Clamp::none;
};

/// The two convolutions with an epilogue; nothing is recorded.
Tensor conv2d_inference(const Tensor& x, const Tensor& w, const ConvOptions& options, const ConvEpilogue& epilogue);
Tensor depthwise_conv2d_inference(const Tensor& x, const Tensor& w, const ConvOptions& options,
                                  const ConvEpilogue& epilogue);

}  // namespace svnet::ops
