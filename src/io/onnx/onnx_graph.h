#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/index.h"

namespace svnet::io {

/// The types of elements in TensorProto that svnet writes, with their numbers there.
enum class OnnxType { f32 = 1, i8 = 3, i64 = 7, bf16 = 16 };

/// A constant of the graph: row-major, little endian.
struct OnnxConstant {
  std::string name;
  OnnxType type;
  std::vector<Index> shape;
  std::vector<std::byte> bytes;
};

using OnnxAttribute = std::variant<std::int64_t, float, std::vector<std::int64_t>>;

/// An operation. Outputs have one value, which has the name of the node.
struct OnnxNode {
  std::string op, name;
  std::vector<std::string> inputs;
  std::vector<std::pair<std::string, OnnxAttribute>> attributes;
};

/// An input or output of the graph, float32.
struct OnnxPort {
  std::string name;
  /// Sizes; a text names a size that the caller chooses ("N").
  std::vector<std::variant<Index, std::string>> shape;
};

/// An ONNX graph in the order in which it runs.
struct OnnxGraph {
  std::vector<OnnxPort> inputs{}, outputs{};
  std::vector<OnnxNode> nodes{};
  std::vector<OnnxConstant> constants{};
  /// What metadata_props say of the model.
  std::map<std::string, std::string> metadata{};

  /// Adds an operation and returns the name of its value.
  std::string add(std::string op, std::string name, std::vector<std::string> inputs,
                  std::vector<std::pair<std::string, OnnxAttribute>> attributes = {});
  /// Adds a constant and returns its name.
  std::string add_constant(std::string name, std::vector<Index> shape, std::span<const float> values);
  std::string add_constant(std::string name, std::vector<Index> shape, std::span<const std::int64_t> values);
};

inline constexpr int kLeastOnnxOpset = 13, kMostOnnxOpset = 17;

/// A ModelProto (github.com/onnx/onnx, onnx.proto). Throws Error, which begins with `name`, for an opset out of range,
/// and if the model is larger than the 2 GiB that protocol buffers can hold.
std::string onnx_bytes(const std::string& name, const OnnxGraph& graph, int opset);

}  // namespace svnet::io
