#include "nn/runtime/compile.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "nn/graph/stored_precision.h"
#include "nn/kernels/batch_norm/channel_norm.h"
#include "nn/kernels/multiply/multiply.h"
#include "nn/runtime/folding.h"
#include "nn/runtime/fusion.h"
#include "nn/runtime/plain_step.h"

namespace svnet::runtime {
namespace {

using kernels::Clamp;

/// Compiles a folded graph. Every node that is not fused into its reader becomes a step, together with the nodes that
/// are fused into it. There is one `emit_step` for each layer.
class Compiler {
 public:
  Compiler(const Graph& graph, const Parameters& parameters, const InferenceOptions& options)
      : graph_(graph),
        parameters_(parameters),
        fusion_(graph, options.observable ? Convolution::direct : options.convolution, options.observable),
        precision_(options.precision),
        ranges_(options.ranges.get()),
        int8_dense_(options.int8_dense),
        value_(graph.nodes().size(), -1) {}

  Program program() {
    for (NodeId id : graph_.inputs()) {
      program_.inputs.push_back(node(id).shape);
      value_[at(id)] = new_value(size(id));
    }
    for (NodeId id = 0; id <= graph_.output(); ++id)
      if (!fusion_.fused(id) && !node(id).is<InputLayer>()) emit(id);
    finish_output();
    return std::move(program_);
  }

 private:
  static std::size_t at(NodeId id) { return static_cast<std::size_t>(id); }
  const GraphNode& node(NodeId id) const { return graph_.node(id); }
  NodeId input(NodeId id) const { return node(id).inputs[0]; }
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

  /// How the layer multiplies its `channels` inputs.
  Product product(NodeId id, Index channels) const {
    Product result{.precision = precision_, .layer = node(id).name};
    if (precision_ != Precision::int8) return result;
    check(ranges_ != nullptr,
          "[precision] int8 needs the ranges of activations. svnet-features and svnet-train find them on pictures, and "
          "a model that was trained in int8 has them; choose f32 or bf16 for others");
    const auto found = ranges_->find(result.layer);
    check(found != ranges_->end(), "[precision] int8: the ranges of activations lack layer ", result.layer,
          ": they are of another network");
    result.ranges = &found->second;
    const auto known = found->second.low.size();
    check(known == static_cast<std::size_t>(channels) && found->second.high.size() == known &&
              found->second.mean.size() == known,
          "[precision] int8: layer ", result.layer, " multiplies ", channels, " channels, but there are ranges of ",
          known);
    return result;
  }

  ValueId new_value(Index elements) {
    program_.sizes.push_back(elements);
    return static_cast<ValueId>(program_.sizes.size()) - 1;
  }
  /// A step that computes the value of `id`.
  void push(NodeId id, StepPointer step, std::vector<ValueId> inputs) {
    assert(std::all_of(inputs.begin(), inputs.end(), [](ValueId value) { return value >= 0; }));
    value_[at(id)] = new_value(size(id));
    program_.steps.push_back({node(id).name, std::move(step), std::move(inputs), value_[at(id)]});
  }

  /// One step to emit: the layer `main`, and what its kernel also does to the result. The step computes the value of
  /// `last`, the last of the nodes that are fused into it.
  struct Fused {
    NodeId last, main;
    ConvolutionFinish finish{};
    std::optional<ValueId> residual{};

    /// Lets the kernel apply the layer's own activation if it can. Returns the activation that is left to do.
    Activation take(Activation activation) {
      const auto clamp = kernels::clamp_of(activation);
      if (clamp && finish.clamp == Clamp::none) finish.clamp = *clamp;
      return clamp ? Activation::none : activation;
    }
  };
  /// The value of `from`, which the step reads, and the residual if there is one.
  std::vector<ValueId> inputs(const Fused& f, NodeId from) const {
    std::vector<ValueId> values{value_[at(from)]};
    if (f.residual) values.push_back(*f.residual);
    return values;
  }

  /// The step of a node that is not fused into another: goes back from the last fused node to the main layer.
  void emit(NodeId id) {
    Fused f{.last = id, .main = id};
    if (node(f.main).is<Pool2dLayer>() && fusion_.fused(input(f.main))) {
      f.finish.pool = true;
      f.main = input(f.main);
    }
    if (const auto* a = node(f.main).as<ActivationLayer>(); a != nullptr && fusion_.fused(input(f.main))) {
      f.finish.clamp = *kernels::clamp_of(a->activation);
      f.main = input(f.main);
    }
    emit_layer(f);
  }

  void emit_layer(const Fused& f) {
    std::visit([&](const auto& layer) { emit_step(f, layer); }, node(f.main).layer);
  }

  void emit_step(const Fused&, const InputLayer&) {}

  /// A sum of two may be the residual of the layer that computes one of them.
  void emit_step(Fused f, const AddLayer&) {
    const auto& terms = node(f.main).inputs;
    std::vector<ValueId> values;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      if (fusion_.fused(terms[i])) {
        f.finish.residual = true;
        f.residual = value_[at(terms[1 - i])];
        f.main = terms[i];
        return emit_layer(f);
      }
      values.push_back(value_[at(terms[i])]);
    }
    push(f.last, add_step(size(f.main), values.size(), f.finish.clamp), values);
  }

  void emit_step(const Fused& f, const MultiplyLayer&) {
    const auto& factors = node(f.main).inputs;
    const bool swapped = size(factors[0]) < size(factors[1]);
    const NodeId x = factors[swapped ? 1 : 0], factor = factors[swapped ? 0 : 1];
    const Index columns = node(x).shape.empty() ? 1 : channels(x);
    const Index positions = size(x) / columns;
    const bool per_channel = size(factor) < size(x);
    const auto body = [=](const StepBuffers& b) {
      const kernels::MultiplyShape shape{b.batch, positions, columns, per_channel};
      kernels::multiply(b.parallel, shape, b.inputs[0], b.inputs[1], b.output);
    };
    push(f.last, plain_step("multiply", size(x), body), {value_[at(x)], value_[at(factor)]});
  }

  void emit_step(Fused f, const Conv2dLayer& l) {
    const Activation rest = f.take(l.activation);
    if (fusion_.is_separable(f.main))
      emit_separable(f, l);
    else
      emit_convolution(f, l);
    activate(f.last, rest);
  }

  void emit_convolution(const Fused& f, const Conv2dLayer& l) {
    const Window window = fusion_.window(f.main, l);
    const bool winograd = fusion_.uses_winograd(f.main), rounds = !winograd && rounds_products(window);
    push(f.last,
         convolution_step(window, get(f.main, "kernel"), bias(f.main, l), f.finish, winograd,
                          rounds ? product(f.main, window.c) : Product{}),
         inputs(f, fusion_.source(f.main)));
  }

  /// A pointwise convolution with the depthwise one before it, and with the expansion before that if it is fused, too.
  void emit_separable(const Fused& f, const Conv2dLayer& pointwise) {
    const NodeId first = input(f.main), from = fusion_.source(first);
    const auto& d = *node(first).as<DepthwiseConv2dLayer>();
    const DepthwisePart depthwise{.kernel = get(first, "depthwise_kernel"),
                                  .bias = bias(first, d),
                                  .relu_input = fusion_.relu_before(first),
                                  .clamp = *kernels::clamp_of(d.activation)};
    const Tensor kernel = get(f.main, "kernel"), own_bias = bias(f.main, pointwise);
    const Window window = fusion_.window(first, d);
    if (!fusion_.fused(from))
      return push(f.last, separable_step(window, depthwise, kernel, own_bias, f.finish, product(f.main, window.c)),
                  inputs(f, from));
    const auto& e = *node(from).as<Conv2dLayer>();
    const ExpansionPart expansion{.kernel = get(from, "kernel"),
                                  .bias = bias(from, e),
                                  .clamp = *kernels::clamp_of(e.activation),
                                  .product = product(from, channels(fusion_.source(from)))};
    push(f.last,
         expanded_separable_step(window, expansion, depthwise, kernel, own_bias, f.finish, product(f.main, window.c)),
         inputs(f, fusion_.source(from)));
  }

  void emit_step(Fused f, const SeparableConv2dLayer& l) {
    const Activation rest = f.take(l.activation);
    const NodeId from = fusion_.source(f.main);
    const DepthwisePart depthwise{.kernel = get(f.main, "depthwise_kernel"), .relu_input = fusion_.relu_before(f.main)};
    const Tensor pointwise = get(f.main, "pointwise_kernel"), own_bias = bias(f.main, l);
    const Window window = fusion_.window(f.main, l);
    if (f.finish.pool) {
      push(f.last,
           separable_max_pool_step(window, depthwise, pointwise, own_bias, f.finish.clamp,
                                   fusion_.pool_window(f.last, *node(f.last).as<Pool2dLayer>()),
                                   product(f.main, window.c)),
           inputs(f, from));
    } else if (fusion_.is_separable(f.main)) {
      push(f.last, separable_step(window, depthwise, pointwise, own_bias, f.finish, product(f.main, window.c)),
           inputs(f, from));
    } else {
      const Window pixel = window_over("runtime", 1, window.oh, window.ow, window.c * l.multiplier, {});
      const ValueId between = new_value(pixel.h * pixel.w * pixel.c);
      program_.steps.push_back(
          {node(f.main).name, depthwise_step(window, depthwise, l.multiplier), {value_[at(from)]}, between});
      push(f.last, convolution_step(pixel, pointwise, own_bias, f.finish, false, product(f.main, pixel.c)), {between});
    }
    activate(f.last, rest);
  }

  void emit_step(Fused f, const DepthwiseConv2dLayer& l) {
    const Activation rest = f.take(l.activation);
    const DepthwisePart part{
        .kernel = get(f.main, "depthwise_kernel"), .bias = bias(f.main, l), .clamp = f.finish.clamp};
    push(f.last, depthwise_step(fusion_.window(f.main, l), part, l.multiplier), inputs(f, fusion_.source(f.main)));
    activate(f.last, rest);
  }

  void emit_step(Fused f, const DenseLayer& l) {
    const Activation rest = f.take(l.activation);
    const Tensor kernel = get(f.main, "kernel"), own_bias = bias(f.main, l);
    const bool is_int8 = int8_dense_ && is_rounded(node(f.main).name + "/kernel", kernel.shape());
    push(f.last,
         is_int8 ? int8_dense_step(kernel, own_bias, f.finish)
                 : dense_step(kernel, own_bias, f.finish, kernels::dense_precision(precision_)),
         inputs(f, input(f.main)));
    activate(f.last, rest);
  }

  void emit_step(const Fused& f, const Pool2dLayer& l) {
    push(f.last, pool_step(fusion_.pool_window(f.main, l), l.kind == PoolKind::max), inputs(f, input(f.main)));
  }

  void emit_step(const Fused& f, const GlobalPool2dLayer& l) {
    const Shape& x = node(input(f.main)).shape;
    const Window window = window_over("runtime", 1, x[0], x[1], x[2], {.kh = x[0], .kw = x[1]});
    push(f.last, pool_step(window, l.kind == PoolKind::max), inputs(f, input(f.main)));
  }

  void emit_step(const Fused& f, const BatchNormLayer& l) {
    const NodeId id = f.main;
    const Tensor gamma = get(id, "gamma"), beta = get(id, "beta"), mean = get(id, "moving_mean"),
                 variance = get(id, "moving_variance");
    Tensor scale = Tensor::empty({gamma.size()}), shift = Tensor::empty({gamma.size()});
    for (Index c = 0; c < gamma.size(); ++c) {
      const auto norm = kernels::channel_norm(gamma.data<float>()[c], beta.data<float>()[c], mean.data<float>()[c],
                                              variance.data<float>()[c], l.options.epsilon);
      scale.data<float>()[c] = static_cast<float>(norm.scale);
      shift.data<float>()[c] = static_cast<float>(norm.shift());
    }
    push(f.last, scale_shift_step(size(id) / gamma.size(), scale, shift, Clamp::none), inputs(f, input(id)));
  }

  void emit_step(const Fused& f, const ActivationLayer& l) {
    alias(f.last);
    activate(f.last, l.activation);
  }

  void emit_step(const Fused& f, const ZeroPadding2dLayer& l) {
    const Shape& x = node(input(f.main)).shape;
    push(f.last, padding_step(x[0], x[1], x[2], l.padding), inputs(f, input(f.main)));
  }

  void emit_step(const Fused& f, const ConcatLayer&) {
    std::vector<Index> widths;
    std::vector<ValueId> values;
    for (NodeId part : node(f.main).inputs) {
      widths.push_back(channels(part));
      values.push_back(value_[at(part)]);
    }
    push(f.last, concat_step(size(f.main) / channels(f.main), widths), values);
  }

  void emit_step(const Fused& f, const FlattenLayer&) { alias(f.last); }
  void emit_step(const Fused& f, const ReshapeLayer&) { alias(f.last); }
  void emit_step(const Fused& f, const DropoutLayer&) { alias(f.last); }

  /// The node's value is that of its input, in memory too.
  void alias(NodeId id) { value_[at(id)] = value_[at(input(id))]; }

  void activate(NodeId id, Activation activation) {
    if (activation == Activation::none) return;
    const ValueId from = value_[at(id)];
    const Index columns = node(id).shape.empty() ? 1 : channels(id);
    push(id, activation_step(size(id) / columns, columns, activation), {from});
  }

  /// The output lies in the caller's memory, so a step must write it.
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
  const Fusion fusion_;
  const Precision precision_;
  const ActivationRanges* const ranges_;
  const bool int8_dense_;
  std::vector<ValueId> value_;  // of each node; -1 if it has none
  Program program_{};
};

}  // namespace

Program compile(const Graph& graph, const Parameters& parameters, NodeId output, const InferenceOptions& options) {
  kernels::check_available(options.precision);
  const FoldedGraph inference = folded(graph, parameters, output);
  return Compiler(inference.graph, inference.parameters, options).program();
}

}  // namespace svnet::runtime
