#include "nn/graph/run.h"

#include "nn/ops/activations.h"
#include "nn/ops/conv2d.h"
#include "nn/ops/dense.h"
#include "nn/ops/dropout.h"
#include "nn/ops/pooling.h"
#include "nn/ops/shaping.h"

namespace svnet {
namespace {

Tensor activated(const Tensor& x, Activation activation) {
  switch (activation) {
    case Activation::none:
      return x;
    case Activation::relu:
      return ops::relu(x);
    case Activation::relu6:
      return ops::relu6(x);
    case Activation::sigmoid:
      return ops::sigmoid(x);
    case Activation::softmax:
      return ops::softmax(x);
  }
  return x;
}

/// How one node gets its parameters: as they are in training, without history in inference.
class Runner {
 public:
  Runner(const Parameters& parameters, Parameters* trained, const TrainingContext* context)
      : parameters_(parameters), trained_(trained), context_(context) {}

  Tensor operator()(const GraphNode& node, NodeId id, const std::vector<Tensor>& x) const {
    return std::visit(
        Overloaded{
            [&](const InputLayer&) { return context_ == nullptr ? x[0].detached() : x[0]; },
            [&](const Conv2dLayer& l) {
              return finished(node, l, ops::conv2d(x[0], get(node, "kernel"), conv_options(l)));
            },
            [&](const DepthwiseConv2dLayer& l) {
              return finished(node, l, ops::depthwise_conv2d(x[0], get(node, "depthwise_kernel"), conv_options(l)));
            },
            [&](const SeparableConv2dLayer& l) {
              return finished(node, l,
                              ops::separable_conv2d(x[0], get(node, "depthwise_kernel"), get(node, "pointwise_kernel"),
                                                    conv_options(l)));
            },
            [&](const DenseLayer& l) {
              return finished(
                  node, l,
                  ops::dense(x[0], get(node, "kernel"), context_ == nullptr ? nullptr : context_->communicator));
            },
            [&](const BatchNormLayer& l) { return batch_norm(node, l, x[0]); },
            [&](const ActivationLayer& l) { return activated(x[0], l.activation); },
            [&](const Pool2dLayer& l) {
              return l.kind == PoolKind::max ? ops::max_pool2d(x[0], l.window) : ops::average_pool2d(x[0], l.window);
            },
            [&](const GlobalPool2dLayer& l) {
              Tensor y = l.kind == PoolKind::max ? ops::global_max_pool2d(x[0]) : ops::global_average_pool2d(x[0]);
              return l.keep_dimensions ? ops::reshape(y, {y.dim(0), 1, 1, y.dim(1)}) : y;
            },
            [&](const ZeroPadding2dLayer& l) { return ops::zero_padding2d(x[0], l.padding); },
            [&](const AddLayer&) { return ops::add(x); }, [&](const ConcatLayer&) { return ops::concat(x); },
            [&](const FlattenLayer&) { return ops::flatten(x[0]); },
            [&](const ReshapeLayer& l) {
              Shape shape = l.shape;
              shape.insert(shape.begin(), x[0].dim(0));
              return ops::reshape(x[0], shape);
            },
            [&](const DropoutLayer& l) {
              return context_ == nullptr
                         ? x[0]
                         : ops::dropout(x[0], l.rate,
                                        {context_->seed, context_->step << 16 | static_cast<std::uint64_t>(id)});
            }},
        node.layer);
  }

 private:
  Tensor get(const GraphNode& node, const char* parameter) const {
    const Tensor& value = parameters_.at(node.name + "/" + parameter);
    return context_ == nullptr ? value.detached() : value;
  }

  static ops::ConvOptions conv_options(const auto& layer) {
    return {.stride_h = layer.stride_h, .stride_w = layer.stride_w, .padding = layer.padding};
  }

  Tensor finished(const GraphNode& node, const auto& layer, const Tensor& y) const {
    return activated(layer.bias ? ops::bias_add(y, get(node, "bias")) : y, layer.activation);
  }

  Tensor batch_norm(const GraphNode& node, const BatchNormLayer& layer, const Tensor& x) const {
    if (context_ == nullptr)
      return ops::batch_norm_inference(x, get(node, "gamma"), get(node, "beta"), get(node, "moving_mean"),
                                       get(node, "moving_variance"), layer.options.epsilon);
    return ops::batch_norm_training(x, get(node, "gamma"), get(node, "beta"), trained_->at(node.name + "/moving_mean"),
                                    trained_->at(node.name + "/moving_variance"), layer.options);
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

std::vector<Tensor> infer(const Graph& graph, const Parameters& parameters, const std::vector<Tensor>& inputs,
                          const std::vector<NodeId>& outputs) {
  return run(graph, Runner(parameters, nullptr, nullptr), inputs, outputs);
}

std::vector<Tensor> train(const Graph& graph, Parameters& parameters, const std::vector<Tensor>& inputs,
                          const std::vector<NodeId>& outputs, const TrainingContext& context) {
  return run(graph, Runner(parameters, &parameters, &context), inputs, outputs);
}

}  // namespace svnet
