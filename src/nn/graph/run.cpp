#include "nn/graph/run.h"

#include "nn/ops/activations.h"
#include "nn/ops/batch_norm.h"
#include "nn/ops/conv2d.h"
#include "nn/ops/dense.h"
#include "nn/ops/dropout.h"
#include "nn/ops/multiply.h"
#include "nn/ops/pooling.h"
#include "nn/ops/shaping.h"

namespace svnet {
namespace {

/// Runs one node: in training with the parameters as they are, in inference without their history. There is one `run`
/// for each layer, which takes the layer and the values of its inputs.
class Runner {
 public:
  Runner(const Parameters& parameters, Parameters* trained, const TrainingContext* context)
      : parameters_(parameters), trained_(trained), context_(context) {}

  Tensor operator()(const GraphNode& node, NodeId id, const std::vector<Tensor>& x) const {
    return std::visit([&](const auto& layer) { return run(layer, {node, id, x, x[0]}); }, node.layer);
  }

 private:
  struct At {
    const GraphNode& node;
    NodeId id;
    const std::vector<Tensor>& inputs;
    const Tensor& x;  // the first input
  };

  Tensor run(const InputLayer&, const At& at) const { return training() ? at.x : at.x.detached(); }

  Tensor run(const Conv2dLayer& l, const At& at) const {
    return with_bias_and_activation(l, at, ops::conv2d(at.x, get(at, "kernel"), conv_options(l)));
  }

  Tensor run(const DepthwiseConv2dLayer& l, const At& at) const {
    return with_bias_and_activation(l, at, ops::depthwise_conv2d(at.x, get(at, "depthwise_kernel"), conv_options(l)));
  }

  Tensor run(const SeparableConv2dLayer& l, const At& at) const {
    return with_bias_and_activation(
        l, at, ops::separable_conv2d(at.x, get(at, "depthwise_kernel"), get(at, "pointwise_kernel"), conv_options(l)));
  }

  Tensor run(const DenseLayer& l, const At& at) const {
    return with_bias_and_activation(l, at,
                                    ops::dense(at.x, get(at, "kernel"), training() ? context_->communicator : nullptr));
  }

  Tensor run(const BatchNormLayer& l, const At& at) const {
    const Tensor gamma = get(at, "gamma"), beta = get(at, "beta");
    if (!training())
      return ops::batch_norm_inference(at.x, gamma, beta, get(at, "moving_mean"), get(at, "moving_variance"),
                                       l.options.epsilon);
    return ops::batch_norm_training(at.x, gamma, beta, trained_->at(at.node.name + "/moving_mean"),
                                    trained_->at(at.node.name + "/moving_variance"), l.options);
  }

  Tensor run(const ActivationLayer& l, const At& at) const { return ops::activation(at.x, l.activation); }

  Tensor run(const Pool2dLayer& l, const At& at) const {
    return l.kind == PoolKind::max ? ops::max_pool2d(at.x, l.window) : ops::average_pool2d(at.x, l.window);
  }

  Tensor run(const GlobalPool2dLayer& l, const At& at) const {
    const Tensor y = l.kind == PoolKind::max ? ops::global_max_pool2d(at.x) : ops::global_average_pool2d(at.x);
    return l.keep_dimensions ? ops::reshape(y, {y.dim(0), 1, 1, y.dim(1)}) : y;
  }

  Tensor run(const ZeroPadding2dLayer& l, const At& at) const { return ops::zero_padding2d(at.x, l.padding); }
  Tensor run(const AddLayer&, const At& at) const { return ops::add(at.inputs); }
  Tensor run(const MultiplyLayer&, const At& at) const { return ops::multiply(at.inputs[0], at.inputs[1]); }
  Tensor run(const ConcatLayer&, const At& at) const { return ops::concat(at.inputs); }
  Tensor run(const FlattenLayer&, const At& at) const { return ops::flatten(at.x); }

  Tensor run(const ReshapeLayer& l, const At& at) const {
    Shape shape = l.shape;
    shape.insert(shape.begin(), at.x.dim(0));
    return ops::reshape(at.x, shape);
  }

  Tensor run(const DropoutLayer& l, const At& at) const {
    if (!training()) return at.x;
    return ops::dropout(at.x, l.rate, {context_->seed, context_->step << 16 | static_cast<std::uint64_t>(at.id)});
  }

  bool training() const { return context_ != nullptr; }

  Tensor get(const At& at, const char* parameter) const {
    const Tensor& value = parameters_.at(at.node.name + "/" + parameter);
    return training() ? value : value.detached();
  }

  ops::ConvOptions conv_options(const auto& layer) const {
    return {.stride_h = layer.stride_h,
            .stride_w = layer.stride_w,
            .padding = layer.padding,
            .convolution = training() ? context_->convolution : kernels::Convolution::automatic};
  }

  Tensor with_bias_and_activation(const auto& layer, const At& at, const Tensor& y) const {
    return ops::activation(layer.bias ? ops::bias_add(y, get(at, "bias")) : y, layer.activation);
  }

  const Parameters& parameters_;
  Parameters* trained_;
  const TrainingContext* context_;
};

void check_input(const GraphNode& node, const Tensor& x) {
  Shape expected = node.shape;
  check(x.defined() && x.rank() >= 1, "[graph] input '", node.name, "' is empty");
  expected.insert(expected.begin(), x.dim(0));
  check(x.shape() == expected, "[graph] input '", node.name, "' expects Nx", to_string(node.shape), ", got ",
        to_string(x.shape()));
}

std::vector<Tensor> run(const Graph& graph, const Runner& runner, const std::vector<Tensor>& inputs,
                        const std::vector<NodeId>& outputs) {
  const auto needed = graph.ancestors(outputs);
  const auto input_nodes = graph.inputs();
  check(inputs.size() == input_nodes.size(), "[graph] takes ", input_nodes.size(), " inputs, got ", inputs.size());
  std::vector<int> readers(needed.size(), 0);
  for (std::size_t i = 0; i < needed.size(); ++i)
    if (needed[i])
      for (NodeId id : graph.nodes()[i].inputs) ++readers[static_cast<std::size_t>(id)];
  for (NodeId id : outputs) ++readers[static_cast<std::size_t>(id)];

  std::vector<Tensor> values(needed.size());
  std::size_t next_input = 0;
  for (std::size_t i = 0; i < needed.size(); ++i) {
    const GraphNode& node = graph.nodes()[i];
    std::vector<Tensor> x;
    if (std::holds_alternative<InputLayer>(node.layer)) x.push_back(inputs[next_input++]);
    if (!needed[i]) continue;
    if (!x.empty()) check_input(node, x[0]);
    for (NodeId id : node.inputs) {
      Tensor& value = values[static_cast<std::size_t>(id)];
      x.push_back(value);
      if (--readers[static_cast<std::size_t>(id)] == 0) value = {};
    }
    values[i] = runner(node, static_cast<NodeId>(i), x);
  }
  std::vector<Tensor> results;
  for (NodeId id : outputs) results.push_back(values[static_cast<std::size_t>(id)]);
  return results;
}

}  // namespace

std::vector<Tensor> run_inference(const Graph& graph, const Parameters& parameters, const std::vector<Tensor>& inputs,
                                  const std::vector<NodeId>& outputs) {
  return run(graph, Runner(parameters, nullptr, nullptr), inputs, outputs);
}

std::vector<Tensor> run_training(const Graph& graph, Parameters& parameters, const std::vector<Tensor>& inputs,
                                 const std::vector<NodeId>& outputs, const TrainingContext& context) {
  return run(graph, Runner(parameters, &parameters, &context), inputs, outputs);
}

}  // namespace svnet
