#pragma once
#include <string>

#include "io/onnx/onnx_graph.h"
#include "nn/graph/stored_precision.h"
#include "nn/kernels/int8/int8_weights.h"
#include "nn/tensor.h"

namespace svnet::io {

/// A kernel as ONNX wants it, and where its output channels are.
struct OnnxKernel {
  std::string name;
  std::vector<Index> shape;
  std::vector<float> values;
  Index channel_axis;
};

/// kernel (KH, KW, C, K) -> (K, C, KH, KW).
OnnxKernel convolution_kernel(std::string name, const Tensor& kernel);
/// kernel (KH, KW, C, M) -> (C·M, 1, KH, KW).
OnnxKernel depthwise_kernel(std::string name, const Tensor& kernel);
/// The rows [first, first + count) of kernel (D, K). If `channels_first` is not empty, they are the pixels of an image
/// (H, W, C) that lies as (C, H, W).
OnnxKernel dense_kernel(std::string name, const Tensor& kernel, Index first, Index count, const Shape& channels_first);

/// Adds the constants of a kernel and the operation that makes float32 of them: none for f32, Cast for bf16,
/// DequantizeLinear for int8. Returns the name of the float32 value. `rounded`: is_rounded of the whole kernel.
std::string add_kernel(OnnxGraph& to, OnnxKernel kernel, StoredPrecision precision, bool rounded);

}  // namespace svnet::io
