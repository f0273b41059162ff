#pragma once
#include <string>
#include <vector>

#include "io/onnx/onnx_graph.h"
#include "nn/graph/stored_precision.h"
#include "nn/graph/graph.h"
#include "nn/graph/parameters.h"

namespace svnet::io {

/// A value of a graph of svnet as an ONNX value.
struct OnnxValue {
  std::string name;
  Shape shape{};  ///< in svnet, without the batch
  /// The image (H, W, C) that lies as (N, C, H, W), although `shape` may be flat already: a transpose back is put off,
  /// because dense layers take it into their weights. Empty: rows, which lie as in svnet.
  Shape channels_first{};
  /// Zeros around the image that are still to be added: a convolution takes them into its own padding.
  Padding zeros{};
  /// The values that are to be put side by side, instead of `name`. A dense layer multiplies each by its own rows of
  /// the weights, so one of them may have batch 1 and another a larger batch.
  std::vector<OnnxValue> parts{};
};

/// Adds the layers of a folded graph (nn/runtime/folding.h) to an ONNX graph. ONNX' convolutions take images
/// (N, C, H, W): an input (N, H, W, C) is transposed once. Only operations are used that ONNX Runtime, OpenCV,
/// TensorRT and OpenVINO run.
class OnnxLayers {
 public:
  /// The names of all values begin with `prefix`.
  OnnxLayers(OnnxGraph& to, StoredPrecision precision, std::string prefix)
      : to_(to), precision_(precision), prefix_(std::move(prefix)) {}

  /// The value of the last node. `inputs`: those of the graph's input nodes, in their order. Throws Error for what
  /// cannot be said in ONNX.
  OnnxValue add(const Graph& graph, const Parameters& parameters, const std::vector<OnnxValue>& inputs);

  /// The value as rows (N, size) in svnet's order.
  std::string rows_of(const OnnxValue& value);

 private:
  class Emission;
  OnnxGraph& to_;
  StoredPrecision precision_;
  std::string prefix_;
};

}  // namespace svnet::io
