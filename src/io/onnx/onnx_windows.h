#pragma once
#include "io/onnx/onnx_operands.h"

namespace svnet::io {

// Operations on windows of images (N, C, H, W). Throw Error if shapes do not fit.

/// Conv, with groups and zeros around the image, and a bias if there is a third input.
OnnxTensor onnx_convolution(const OnnxOperands& node);

enum class OnnxPool { max, average };

/// MaxPool, or AveragePool that does not count the padding.
OnnxTensor onnx_pool(const OnnxOperands& node, OnnxPool kind);

/// GlobalMaxPool or GlobalAveragePool, (N, C, 1, 1). An average is summed in f64.
OnnxTensor onnx_global_pool(const OnnxOperands& node, OnnxPool kind);

}  // namespace svnet::io
