#pragma once
#include <string>
#include <string_view>

#include "io/onnx/onnx_graph.h"

namespace svnet::io {

/// The graph of a ModelProto that onnx_bytes wrote; `opset`, if not nullptr, receives its version. Throws Error, which
/// begins with `name`, for bytes that are not such a model.
OnnxGraph parse_onnx(const std::string& name, std::string_view bytes, int* opset = nullptr);

}  // namespace svnet::io
