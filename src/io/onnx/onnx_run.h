#pragma once
#include <map>
#include <string>

#include "io/onnx/onnx_graph.h"
#include "io/onnx/onnx_tensor.h"

namespace svnet::io {

/// The first output of a graph, computed from the definitions of ONNX' operations (onnx.ai/onnx/operators), of those
/// that svnet writes. It shares nothing with nn/runtime but the product of matrices, so that an export can be compared
/// with the model that it was made from. Throws Error that names the node if it has another operation, or if shapes do
/// not fit.
OnnxTensor run_onnx(const OnnxGraph& graph, const std::map<std::string, OnnxTensor>& inputs);

}  // namespace svnet::io
