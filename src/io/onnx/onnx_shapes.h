#pragma once
#include "io/onnx/onnx_operands.h"

namespace svnet::io {

// Operations that move elements and compute nothing. Throw Error if shapes do not fit.

OnnxTensor onnx_transpose(const OnnxOperands& node);
OnnxTensor onnx_flatten(const OnnxOperands& node);
OnnxTensor onnx_reshape(const OnnxOperands& node);
OnnxTensor onnx_concat(const OnnxOperands& node);
OnnxTensor onnx_pad(const OnnxOperands& node);

/// A slice of step -1 over a whole axis, the only one that svnet writes.
OnnxTensor onnx_reversed_slice(const OnnxOperands& node);

}  // namespace svnet::io
