#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/onnx/onnx_graph.h"
#include "io/onnx/onnx_tensor.h"

namespace svnet::io {

/// What an operation is computed from: the inputs and the attributes of its node. Refers to the node, to the tensors
/// and to the constants, which must live as long. Errors name the node.
class OnnxOperands {
 public:
  /// `tensors` and `constants` are known by the names that inputs of nodes have.
  OnnxOperands(const OnnxNode& node, std::map<std::string, const OnnxTensor*> tensors,
               const std::map<std::string, const OnnxConstant*>& constants);

  /// The number of inputs.
  std::size_t count() const { return node_.inputs.size(); }
  /// Input i. Throws Error if it is missing.
  const OnnxTensor& x(std::size_t i = 0) const;
  /// Input i as the file has it. Throws Error if it is not a constant.
  const OnnxConstant& constant(std::size_t i) const;
  /// Input i. Throws Error if it is not a constant of int64.
  std::vector<std::int64_t> integers(std::size_t i) const;

  /// Attributes; `value` if the node does not have it.
  std::vector<std::int64_t> integers(const char* name, std::vector<std::int64_t> value) const;
  std::int64_t integer(const char* name, std::int64_t value) const;
  float number(const char* name, float value = 0) const;

  /// Throws Error.
  [[noreturn]] void refuse(const std::string& why) const;

 private:
  const OnnxNode& node_;
  std::map<std::string, const OnnxTensor*> tensors_;
  const std::map<std::string, const OnnxConstant*>& constants_;
};

}  // namespace svnet::io
