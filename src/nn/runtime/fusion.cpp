#include "nn/runtime/fusion.h"

#include "nn/kernels/separable/strips.h"
#include "nn/kernels/winograd/winograd.h"

namespace svnet::runtime {

using kernels::clamp_of;

namespace {

bool is_valid(const Padding& padding) { return padding.kind == Padding::Kind::valid; }

bool is_plain_pointwise(const Conv2dLayer& l) {
  return l.kh == 1 && l.kw == 1 && l.stride_h == 1 && l.stride_w == 1 && l.padding.kind != Padding::Kind::explicit_;
}

}  // namespace

Fusion::Fusion(const Graph& graph, Convolution convolution, bool observable)
    : graph_(graph),
      convolution_(convolution),
      observable_(observable),
      readers_(graph.nodes().size(), 0),
      fused_(graph.nodes().size(), false) {
  for (const auto& node : graph.nodes())
    for (NodeId id : node.inputs) ++readers_[at(id)];
  ++readers_[at(graph.output())];  // the caller
  for (NodeId id = 0; id <= graph.output(); ++id) fuse_inputs(id);
}

NodeId Fusion::source(NodeId id) const {
  const NodeId input = node(id).inputs[0];
  return fused(input) && (node(input).is<ZeroPadding2dLayer>() || node(input).is<ActivationLayer>())
             ? node(input).inputs[0]
             : input;
}

bool Fusion::relu_before(NodeId id) const {
  const NodeId input = node(id).inputs[0];
  return fused(input) && node(input).is<ActivationLayer>();
}

bool Fusion::is_separable(NodeId id) const {
  if (const auto* l = node(id).as<SeparableConv2dLayer>()) return l->multiplier == 1;
  const NodeId input = node(id).inputs[0];
  return node(id).is<Conv2dLayer>() && node(input).is<DepthwiseConv2dLayer>() && fused(input);
}

bool Fusion::uses_winograd(NodeId id) const {
  const auto* l = node(id).as<Conv2dLayer>();
  if (l == nullptr || convolution_ == Convolution::direct) return false;
  const Window w = window(id, *l);
  return kernels::winograd_fits(w, l->filters) && (convolution_ == Convolution::winograd || (w.c >= 32 && w.oh >= 4));
}

Window Fusion::window_of(NodeId id, Index kh, Index kw, Index stride_h, Index stride_w, const Padding& own) const {
  const Shape& x = node(source(id)).shape;
  const NodeId input = node(id).inputs[0];
  const auto* border = fused(input) ? node(input).as<ZeroPadding2dLayer>() : nullptr;
  return window_over("runtime", 1, x[0], x[1], x[2],
                     {.kh = kh,
                      .kw = kw,
                      .stride_h = stride_h,
                      .stride_w = stride_w,
                      .padding = border != nullptr ? border->padding : own});
}

Window Fusion::pool_window(NodeId id, const Pool2dLayer& layer) const {
  const Shape& x = node(node(id).inputs[0]).shape;
  return window_over("runtime", 1, x[0], x[1], x[2], layer.window);
}

void Fusion::fuse_padding(NodeId input, const Padding& own) {
  if (node(input).is<ZeroPadding2dLayer>() && is_valid(own)) fuse(input);
}

/// Marks the inputs of the node that become part of its step. Inputs come before their readers, so it is known already
/// what is fused into them. A layer that is not listed runs as a step of its own.
void Fusion::fuse_inputs(NodeId id) {
  if (node(id).inputs.empty()) return;
  const NodeId input = node(id).inputs[0];
  const bool alone = only_reader_of(input);
  std::visit(Overloaded{[&](const Conv2dLayer& l) {
                          if (!alone) return;
                          fuse_padding(input, l.padding);
                          const auto* depthwise = node(input).as<DepthwiseConv2dLayer>();
                          if (depthwise == nullptr || depthwise->multiplier != 1 || !clamp_of(depthwise->activation) ||
                              !is_plain_pointwise(l))
                            return;
                          fuse(input);
                          if (can_expand(input)) fuse(source(input));
                        },
                        [&](const DepthwiseConv2dLayer& l) {
                          if (alone) fuse_padding(input, l.padding);
                        },
                        [&](const SeparableConv2dLayer& l) {
                          if (!alone || l.multiplier != 1) return;
                          fuse_padding(input, l.padding);
                          // An activation into which an addition is fused is a step of its own.
                          if (const auto* a = node(input).as<ActivationLayer>();
                              a != nullptr && a->activation == Activation::relu && !fused(node(input).inputs[0]))
                            fuse(input);
                        },
                        [&](const AddLayer&) {
                          if (node(id).inputs.size() != 2) return;
                          for (NodeId which : {node(id).inputs[1], node(id).inputs[0]})
                            if (only_reader_of(which) && can_add(which)) return fuse(which);
                        },
                        [&](const ActivationLayer& l) {
                          if (alone && node(input).is<AddLayer>() && clamp_of(l.activation)) fuse(input);
                        },
                        [&](const Pool2dLayer& l) {
                          if (alone && can_pool(id, l)) fuse(input);
                        },
                        [](const auto&) {}},
             node(id).layer);
}

/// Whether the input of a depthwise convolution can be computed row by row within its step.
bool Fusion::can_expand(NodeId depthwise) const {
  const NodeId from = source(depthwise);
  const auto* l = node(from).as<Conv2dLayer>();
  return !observable_ && l != nullptr && only_reader_of(from) && clamp_of(l->activation) && !is_separable(from) &&
         window(from, *l).reads_in_place() &&
         kernels::fits_strips(window(depthwise, *node(depthwise).as<DepthwiseConv2dLayer>()));
}

/// Whether the node's kernel can add another value to its output.
bool Fusion::can_add(NodeId id) const {
  if (const auto* l = node(id).as<SeparableConv2dLayer>()) return is_separable(id) && l->activation == Activation::none;
  const auto* l = node(id).as<Conv2dLayer>();
  return l != nullptr && l->activation == Activation::none && !uses_winograd(id);
}

/// Whether the kernel of the pool's input can also pool.
bool Fusion::can_pool(NodeId id, const Pool2dLayer& layer) const {
  if (layer.kind != PoolKind::max) return false;
  const NodeId input = node(id).inputs[0];
  const WindowOptions& w = layer.window;
  if (const auto* l = node(input).as<Conv2dLayer>(); l != nullptr && uses_winograd(input))
    return w.kh == 2 && w.kw == 2 && w.stride_h == 2 && w.stride_w == 2 && is_valid(w.padding) &&
           clamp_of(l->activation);
  const auto* separable = node(input).as<SeparableConv2dLayer>();
  return separable != nullptr && is_separable(input) && clamp_of(separable->activation) &&
         kernels::fits_strips(pool_window(id, layer));
}

}  // namespace svnet::runtime
