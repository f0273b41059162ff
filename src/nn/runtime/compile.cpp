#include "nn/runtime/compile.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "nn/kernels/separable/strips.h"
#include "nn/kernels/winograd/winograd.h"
#include "nn/runtime/folding.h"

namespace svnet::runtime {
namespace {

using kernels::Clamp;

std::optional<Clamp> clamp_of(Activation activation) {
  switch (activation) {
    case Activation::none:
      return Clamp::none;
    case Activation::relu:
      return Clamp::relu;
    case Activation::relu6:
      return Clamp::relu6;
    default:
      return {};
  }
}

/// Compiles a folded graph. A node may be fused into its only reader; every other one becomes a step of its own, which
/// takes along what is fused into it.
class Compiler {
 public:
  Compiler(const Graph& graph, const Parameters& parameters, Convolution convolution, Precision precision)
      : graph_(graph),
        parameters_(parameters),
        convolution_(convolution),
        precision_(precision),
        readers_(graph.nodes().size(), 0),
        fused_(graph.nodes().size(), false),
        value_(graph.nodes().size(), -1) {
    for (const auto& node : graph.nodes())
      for (NodeId id : node.inputs) ++readers_[at(id)];
    ++readers_[at(graph.output())];  // whoever asked for it
  }

  Program program() {
    for (NodeId id = 0; id <= graph_.output(); ++id) fuse_inputs(id);
    for (NodeId id : graph_.inputs()) {
      program_.inputs.push_back(node(id).shape);
      value_[at(id)] = new_value(id);
    }
    for (NodeId id = 0; id <= graph_.output(); ++id)
      if (!fused_[at(id)] && !is<InputLayer>(id)) emit(id);
    finish_output();
    return std::move(program_);
  }

 private:
  static std::size_t at(NodeId id) { return static_cast<std::size_t>(id); }
  const GraphNode& node(NodeId id) const { return graph_.node(id); }
  template <class L>
  const L* as(NodeId id) const {
    return std::get_if<L>(&node(id).layer);
  }
  template <class L>
  bool is(NodeId id) const {
    return as<L>(id) != nullptr;
  }
  Index size(NodeId id) const { return element_count(node(id).shape); }
  Index channels(NodeId id) const { return node(id).shape.back(); }

  Tensor get(NodeId id, const char* name) const {
    Tensor value = parameters_.at(node(id).name + "/" + name).detached();
    check(value.dtype() == DType::f32, "[runtime] parameter ", node(id).name, "/", name, " is not f32");
    return value;
  }
  template <class L>
  Tensor bias(NodeId id, const L& layer) const {
    return layer.bias ? get(id, "bias") : Tensor{};
  }

  // --- windows -------------------------------------------------------------------------------------------------------

  template <class L>
  Window window(NodeId id, const L& layer) const {
    const Shape& x = node(source(id)).shape;
    Padding padding = layer.padding;
    if (const auto* border = padding_before(id)) padding = border->padding;
    return window_over(
        "runtime", 1, x[0], x[1], x[2],
        {.kh = layer.kh, .kw = layer.kw, .stride_h = layer.stride_h, .stride_w = layer.stride_w, .padding = padding});
  }
  Window pool_window(NodeId id, const Pool2dLayer& l) const {
    const Shape& x = node(node(id).inputs[0]).shape;
    return window_over("runtime", 1, x[0], x[1], x[2], l.window);
  }
  /// The zero padding fused into the node, if any.
  const ZeroPadding2dLayer* padding_before(NodeId id) const {
    const NodeId input = node(id).inputs[0];
    return fused_[at(input)] ? as<ZeroPadding2dLayer>(input) : nullptr;
  }
  bool relu_before(NodeId id) const {
    return fused_[at(node(id).inputs[0])] && is<ActivationLayer>(node(id).inputs[0]);
  }
  /// The node whose value a convolution reads: past the padding or ReLU that is fused into it.
  NodeId source(NodeId id) const {
    const NodeId input = node(id).inputs[0];
    return fused_[at(input)] && (is<ZeroPadding2dLayer>(input) || is<ActivationLayer>(input)) ? node(input).inputs[0]
                                                                                              : input;
  }

  // --- what fuses ----------------------------------------------------------------------------------------------------

  bool only_reader_of(NodeId input) const { return readers_[at(input)] == 1 && !fused_[at(input)]; }

  /// Nodes that run as depthwise + pointwise in one.
  bool is_separable(NodeId id) const {
    if (const auto* l = as<SeparableConv2dLayer>(id)) return l->multiplier == 1;
    return is<Conv2dLayer>(id) && is<DepthwiseConv2dLayer>(node(id).inputs[0]) && fused_[at(node(id).inputs[0])];
  }
  bool uses_winograd(NodeId id) const {
    const auto* l = as<Conv2dLayer>(id);
    if (l == nullptr || convolution_ == Convolution::direct) return false;
    const Window w = window(id, *l);
    return kernels::winograd_fits(w, l->filters) && (convolution_ == Convolution::winograd || (w.c >= 32 && w.oh >= 4));
  }

  static bool plain_padding(const Padding& padding) { return padding.kind == Padding::Kind::valid; }

  /// Marks those inputs of the node that become part of its step. Inputs come before their readers, so what is fused
  /// into an input is known already.
  void fuse_inputs(NodeId id) {
    if (node(id).inputs.empty()) return;
    const NodeId input = node(id).inputs[0];
    const bool alone = only_reader_of(input);
    const auto fuse = [&](NodeId which) { fused_[at(which)] = true; };
    std::visit(Overloaded{[&](const Conv2dLayer& l) {
                            if (!alone) return;
                            if (is<ZeroPadding2dLayer>(input) && plain_padding(l.padding)) fuse(input);
                            const auto* depthwise = as<DepthwiseConv2dLayer>(input);
                            if (depthwise != nullptr && depthwise->multiplier == 1 && clamp_of(depthwise->activation) &&
                                l.kh == 1 && l.kw == 1 && l.stride_h == 1 && l.stride_w == 1 &&
                                l.padding.kind != Padding::Kind::explicit_) {
                              fuse(input);
                              if (can_expand(input)) fuse(source(input));
                            }
                          },
                          [&](const DepthwiseConv2dLayer& l) {
                            if (alone && is<ZeroPadding2dLayer>(input) && plain_padding(l.padding)) fuse(input);
                          },
                          [&](const SeparableConv2dLayer& l) {
                            if (!alone || l.multiplier != 1) return;
                            if (is<ZeroPadding2dLayer>(input) && plain_padding(l.padding)) fuse(input);
                            // An activation that takes an addition along is a step of its own.
                            if (const auto* a = as<ActivationLayer>(input);
                                a != nullptr && a->activation == Activation::relu && !fused_[at(node(input).inputs[0])])
                              fuse(input);
                          },
                          [&](const AddLayer&) {
                            if (node(id).inputs.size() != 2) return;
                            for (NodeId which : {node(id).inputs[1], node(id).inputs[0]})
                              if (only_reader_of(which) && can_add(which)) return fuse(which);
                          },
                          [&](const ActivationLayer& l) {
                            if (alone && is<AddLayer>(input) && clamp_of(l.activation)) fuse(input);
                          },
                          [&](const Pool2dLayer& l) {
                            const auto& w = l.window;
                            if (alone && l.kind == PoolKind::max && w.kh == 2 && w.kw == 2 && w.stride_h == 2 &&
                                w.stride_w == 2 && plain_padding(w.padding) && uses_winograd(input) &&
                                clamp_of(as<Conv2dLayer>(input)->activation))
                              fuse(input);
                            const auto* separable = as<SeparableConv2dLayer>(input);
                            if (alone && l.kind == PoolKind::max && separable != nullptr && is_separable(input) &&
                                clamp_of(separable->activation) && kernels::fits_strips(pool_window(id, l)))
                              fuse(input);
                          },
                          [](const auto&) {}},
               node(id).layer);
  }

  /// Whether what a depthwise convolution reads can be made row by row as it is needed.
  bool can_expand(NodeId depthwise) const {
    const NodeId from = source(depthwise);
    const auto* l = as<Conv2dLayer>(from);
    return l != nullptr && only_reader_of(from) && clamp_of(l->activation) && !is_separable(from) &&
           window(from, *l).reads_in_place() &&
           kernels::fits_strips(window(depthwise, *as<DepthwiseConv2dLayer>(depthwise)));
  }

  /// Whether the node's kernel can add another value to its output.
  bool can_add(NodeId id) const {
    if (const auto* l = as<SeparableConv2dLayer>(id)) return is_separable(id) && l->activation == Activation::none;
    const auto* l = as<Conv2dLayer>(id);
    return l != nullptr && l->activation == Activation::none && !uses_winograd(id);
  }

  // --- steps ---------------------------------------------------------------------------------------------------------

  ValueId new_value(NodeId id) {
    program_.sizes.push_back(size(id));
    return static_cast<ValueId>(program_.sizes.size()) - 1;
  }
  /// A step that computes the value of `id`.
  void push(NodeId id, StepPointer step, std::vector<ValueId> inputs) {
    assert(std::all_of(inputs.begin(), inputs.end(), [](ValueId input) { return input >= 0; }));
    value_[at(id)] = new_value(id);
    program_.steps.push_back({node(id).name, std::move(step), std::move(inputs), value_[at(id)]});
  }

  /// The step of a node that is not fused into another.
  void emit(NodeId id) {
    ConvolutionFinish finish;
    NodeId main = id;
    if (is<Pool2dLayer>(main) && fused_[at(node(main).inputs[0])]) {
      finish.pool = true;
      main = node(main).inputs[0];
    }
    if (const auto* a = as<ActivationLayer>(main); a != nullptr && fused_[at(node(main).inputs[0])]) {
      finish.clamp = *clamp_of(a->activation);
      main = node(main).inputs[0];
    }
    if (is<AddLayer>(main)) return emit_add(id, main, finish);
    emit_layer(id, main, finish, {});
  }

  void emit_add(NodeId id, NodeId add, ConvolutionFinish finish) {
    const auto& inputs = node(add).inputs;
    std::vector<ValueId> values;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      if (fused_[at(inputs[i])]) {
        finish.residual = true;
        return emit_layer(id, inputs[i], finish, value_[at(inputs[1 - i])]);
      }
      values.push_back(value_[at(inputs[i])]);
    }
    push(id, add_step(size(add), values.size(), finish.clamp), values);
  }

  /// The step of layer `main`, whose result is known as that of `id`, the last of what is fused with it.
  void emit_layer(NodeId id, NodeId main, ConvolutionFinish finish, std::optional<ValueId> residual) {
    const auto inputs = [&](NodeId from) {
      std::vector<ValueId> values{value_[at(from)]};
      if (residual) values.push_back(*residual);
      return values;
    };
    // An activation that the kernel cannot apply becomes a step of its own.
    const auto finished = [&](Activation activation) {
      if (const auto clamp = clamp_of(activation); clamp && finish.clamp == Clamp::none) finish.clamp = *clamp;
      return clamp_of(activation) ? Activation::none : activation;
    };
    std::visit(
        Overloaded{
            [&](const Conv2dLayer& l) {
              const Activation rest = finished(l.activation);
              if (is_separable(main)) {
                const NodeId first = node(main).inputs[0];
                const auto& d = *as<DepthwiseConv2dLayer>(first);
                const DepthwisePart part{.kernel = get(first, "depthwise_kernel"),
                                         .bias = bias(first, d),
                                         .relu_input = relu_before(first),
                                         .clamp = *clamp_of(d.activation)};
                const NodeId from = source(first);
                if (fused_[at(from)]) {
                  const auto& e = *as<Conv2dLayer>(from);
                  const ExpansionPart expansion{
                      .kernel = get(from, "kernel"), .bias = bias(from, e), .clamp = *clamp_of(e.activation)};
                  push(id,
                       expanded_separable_step(window(first, d), expansion, part, get(main, "kernel"), bias(main, l),
                                               finish, precision_),
                       inputs(source(from)));
                } else {
                  push(id,
                       separable_step(window(first, d), part, get(main, "kernel"), bias(main, l), finish, precision_),
                       inputs(from));
                }
              } else {
                push(id,
                     convolution_step(window(main, l), get(main, "kernel"), bias(main, l), finish, uses_winograd(main),
                                      precision_),
                     inputs(source(main)));
              }
              activate(id, rest);
            },
            [&](const SeparableConv2dLayer& l) {
              const Activation rest = finished(l.activation);
              const DepthwisePart part{.kernel = get(main, "depthwise_kernel"), .relu_input = relu_before(main)};
              const Tensor pointwise = get(main, "pointwise_kernel");
              if (finish.pool) {
                push(id,
                     separable_max_pool_step(window(main, l), part, pointwise, bias(main, l), finish.clamp,
                                             pool_window(id, *as<Pool2dLayer>(id)), precision_),
                     inputs(source(main)));
              } else if (is_separable(main)) {
                push(id, separable_step(window(main, l), part, pointwise, bias(main, l), finish, precision_),
                     inputs(source(main)));
              } else {
                const Window w = window(main, l);
                program_.sizes.push_back(w.oh * w.ow * w.c * l.multiplier);
                const auto between = static_cast<ValueId>(program_.sizes.size()) - 1;
                program_.steps.push_back(
                    {node(main).name, depthwise_step(w, part, l.multiplier), {value_[at(source(main))]}, between});
                const Window pixel = window_over("runtime", 1, w.oh, w.ow, w.c * l.multiplier, {});
                push(id, convolution_step(pixel, pointwise, bias(main, l), finish, false, precision_), {between});
              }
              activate(id, rest);
            },
            [&](const DepthwiseConv2dLayer& l) {
              const Activation rest = finished(l.activation);
              const DepthwisePart part{
                  .kernel = get(main, "depthwise_kernel"), .bias = bias(main, l), .clamp = finish.clamp};
              push(id, depthwise_step(window(main, l), part, l.multiplier), {value_[at(source(main))]});
              activate(id, rest);
            },
            [&](const DenseLayer& l) {
              const Activation rest = finished(l.activation);
              push(id, dense_step(get(main, "kernel"), bias(main, l), finish, precision_),
                   {value_[at(node(main).inputs[0])]});
              activate(id, rest);
            },
            [&](const Pool2dLayer& l) {
              push(id, pool_step(pool_window(main, l), l.kind == PoolKind::max), {value_[at(node(main).inputs[0])]});
            },
            [&](const GlobalPool2dLayer& l) {
              const Shape& x = node(node(main).inputs[0]).shape;
              push(id,
                   pool_step(window_over("runtime", 1, x[0], x[1], x[2], {.kh = x[0], .kw = x[1]}),
                             l.kind == PoolKind::max),
                   {value_[at(node(main).inputs[0])]});
            },
            [&](const BatchNormLayer& l) { emit_norm(id, l); },
            [&](const ActivationLayer& l) {
              alias(id);
              activate(id, l.activation);
            },
            [&](const ZeroPadding2dLayer& l) {
              const Shape& x = node(node(main).inputs[0]).shape;
              push(id, padding_step(x[0], x[1], x[2], l.padding), {value_[at(node(main).inputs[0])]});
            },
            [&](const ConcatLayer&) {
              std::vector<Index> widths;
              std::vector<ValueId> values;
              for (NodeId input : node(main).inputs) {
                widths.push_back(channels(input));
                values.push_back(value_[at(input)]);
              }
              push(id, concat_step(size(main) / channels(main), widths), values);
            },
            [&](const FlattenLayer&) { alias(id); }, [&](const ReshapeLayer&) { alias(id); },
            [&](const DropoutLayer&) { alias(id); }, [](const InputLayer&) {}, [](const AddLayer&) {}},
        node(main).layer);
  }

  /// The node's value is that of its input, in memory too.
  void alias(NodeId id) { value_[at(id)] = value_[at(node(id).inputs[0])]; }

  void activate(NodeId id, Activation activation) {
    if (activation == Activation::none) return;
    const ValueId from = value_[at(id)];
    const Index count = size(id), last = node(id).shape.empty() ? 1 : channels(id);
    if (const auto clamp = clamp_of(activation))
      push(id, clamp_step(count, *clamp), {from});
    else if (activation == Activation::sigmoid)
      push(id, sigmoid_step(count), {from});
    else
      push(id, softmax_step(count / last, last), {from});
  }

  void emit_norm(NodeId id, const BatchNormLayer& l) {
    const Tensor gamma = get(id, "gamma"), beta = get(id, "beta"), mean = get(id, "moving_mean"),
                 variance = get(id, "moving_variance");
    Tensor scale = Tensor::empty({gamma.size()}), shift = Tensor::empty({gamma.size()});
    for (Index c = 0; c < gamma.size(); ++c) {
      const double factor = gamma.data<float>()[c] / std::sqrt(variance.data<float>()[c] + l.options.epsilon);
      scale.data<float>()[c] = static_cast<float>(factor);
      shift.data<float>()[c] = static_cast<float>(beta.data<float>()[c] - mean.data<float>()[c] * factor);
    }
    push(id, scale_shift_step(size(id) / gamma.size(), scale, shift, Clamp::none), {value_[at(node(id).inputs[0])]});
  }

  /// The output must be written by a step, into memory of the caller's.
  void finish_output() {
    const NodeId output = graph_.output();
    program_.output_shape = node(output).shape;
    program_.output = value_[at(output)];
    if (program_.output >= static_cast<ValueId>(program_.inputs.size())) return;
    push(output, copy_step(size(output)), {program_.output});
    program_.output = value_[at(output)];
  }

  const Graph& graph_;
  const Parameters& parameters_;
  const Convolution convolution_;
  const Precision precision_;
  std::vector<int> readers_;
  std::vector<bool> fused_;     // into its only reader
  std::vector<ValueId> value_;  // of each node
  Program program_{};
};

}  // namespace

Program compile(const Graph& graph, const Parameters& parameters, NodeId output, Convolution convolution,
                Precision precision) {
  kernels::check_available(precision);
  const FoldedGraph inference = folded(graph, parameters, output);
  return Compiler(inference.graph, inference.parameters, convolution, precision).program();
}

}  // namespace svnet::runtime
