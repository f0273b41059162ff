#pragma once
#include <vector>

#include "nn/graph/graph.h"
#include "nn/kernels/convolution_choice.h"
#include "nn/kernels/window.h"

namespace svnet::runtime {

using kernels::Convolution;

/// Decides which nodes of a folded graph become part of the step of their only reader: padding and ReLU before a
/// convolution; a convolution before an addition, activation or pool; the two or three convolutions of a separable
/// block. Requires that the graph outlives it.
class Fusion {
 public:
  /// `observable`: an expansion stays a step of its own.
  Fusion(const Graph& graph, Convolution convolution, bool observable = false);

  /// Whether the node is part of its reader's step.
  bool fused(NodeId id) const { return fused_[at(id)]; }
  /// The node whose value the step of a convolution reads: the input of a padding or ReLU that is fused into it.
  NodeId source(NodeId id) const;
  /// Whether a ReLU is fused into the convolution that reads it.
  bool relu_before(NodeId id) const;
  /// Whether the node runs as a depthwise and a pointwise convolution in one step.
  bool is_separable(NodeId id) const;
  bool uses_winograd(NodeId id) const;

  /// The window of a convolution over one image, with the padding that is fused into it.
  template <class L>
  Window window(NodeId id, const L& layer) const {
    return window_of(id, layer.kh, layer.kw, layer.stride_h, layer.stride_w, layer.padding);
  }
  Window pool_window(NodeId id, const Pool2dLayer& layer) const;

 private:
  static std::size_t at(NodeId id) { return static_cast<std::size_t>(id); }
  const GraphNode& node(NodeId id) const { return graph_.node(id); }

  Window window_of(NodeId id, Index kh, Index kw, Index stride_h, Index stride_w, const Padding& own) const;
  bool only_reader_of(NodeId input) const { return readers_[at(input)] == 1 && !fused(input); }
  void fuse(NodeId id) { fused_[at(id)] = true; }
  void fuse_inputs(NodeId id);
  void fuse_padding(NodeId input, const Padding& own);
  bool can_expand(NodeId depthwise) const;
  bool can_add(NodeId id) const;
  bool can_pool(NodeId id, const Pool2dLayer& layer) const;

  const Graph& graph_;
  const Convolution convolution_;
  const bool observable_;
  std::vector<int> readers_;
  std::vector<bool> fused_;
};

}  // namespace svnet::runtime
