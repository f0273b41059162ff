#include "train/pretraining.h"

#include <algorithm>
#include <numeric>

#include "base/text.h"
#include "models/trained_graph.h"
#include "nn/ops/losses.h"
#include "nn/optim/optimizer.h"
#include "nn/optim/schedule.h"
#include "nn/runtime/inference.h"
#include "train/dataset_rows.h"
#include "train/epoch_order.h"
#include "train/finite.h"
#include "train/labelled_images.h"
#include "train/training_step.h"

namespace svnet::train {
namespace {

/// Images to train on, and to validate on.
struct ImageSplit {
  std::vector<std::string> categories;
  std::vector<LabelledImages::Example> training, validation;
};

ImageSplit split_images(const ViewDataset& dataset, const PretrainingOptions& options) {
  const std::vector<bool> excluded = named_categories(dataset, options.exclude, "--exclude");
  std::vector<Index> objects_left(dataset.categories.size(), 0);  // to train on
  for (const auto& object : dataset.objects) ++objects_left[static_cast<std::size_t>(object.category)];
  ImageSplit split;
  std::vector<Index> class_of(dataset.categories.size(), -1);
  for (std::size_t c = 0; c < dataset.categories.size(); ++c) {
    if (excluded[c]) continue;
    check(objects_left[c] > options.validation_objects, dataset.root.string(), ": category '", dataset.categories[c],
          "' has ", objects_left[c], " objects, and --validation-objects ", options.validation_objects,
          " leaves none of them to train on");
    objects_left[c] -= options.validation_objects;
    class_of[c] = static_cast<Index>(split.categories.size());
    split.categories.push_back(dataset.categories[c]);
  }
  check(split.categories.size() >= 2, dataset.root.string(), ": ", split.categories.size(), " categories to tell apart",
        options.exclude.empty() ? "" : " besides the excluded ones", ", at least 2 are needed");
  std::vector<bool> trained_on;  // per object
  for (const auto& object : dataset.objects)
    trained_on.push_back(objects_left[static_cast<std::size_t>(object.category)]-- > 0);
  for (std::size_t v = 0; v < dataset.views.size(); ++v) {
    const View& view = dataset.views[v];
    const Index label = class_of[static_cast<std::size_t>(view.category)];
    if (label < 0) continue;
    auto& part = trained_on[static_cast<std::size_t>(view.object)] ? split.training : split.validation;
    part.push_back({static_cast<Index>(v), label});
  }
  return split;
}

/// In how many rows of logits (B, classes) the largest one is that of the row's class.
Index recognised(const Tensor& logits, const std::vector<Index>& classes) {
  const Index count = logits.dim(1);
  Index right = 0;
  for (std::size_t row = 0; row < classes.size(); ++row) {
    const float* z = logits.data<float>() + static_cast<Index>(row) * count;
    right += std::max_element(z, z + count) - z == classes[row];
  }
  return right;
}

/// The share of the images that the network classifies correctly.
double accuracy(const Graph& graph, const Parameters& parameters, const LabelledImages& images,
                const InferenceOptions& options) {
  constexpr Index kBatch = 64;
  const Inference network(graph, parameters, graph.output(), options);
  std::vector<std::int32_t> indices(static_cast<std::size_t>(images.size()));
  std::iota(indices.begin(), indices.end(), 0);
  Index right = 0;
  for (Index begin = 0; begin < images.size(); begin += kBatch) {
    const auto count = static_cast<std::size_t>(std::min(kBatch, images.size() - begin));
    const auto batch = images.batch(std::span(indices).subspan(static_cast<std::size_t>(begin), count));
    right += recognised(network.run({batch.pixels}), batch.classes);
  }
  return static_cast<double>(right) / static_cast<double>(images.size());
}

/// The graph with another momentum of the moving statistics of batch norms.
Graph with_momentum(const Graph& graph, double momentum) {
  Graph changed;
  for (const GraphNode& node : graph.nodes()) {
    Layer layer = node.layer;
    if (auto* norm = std::get_if<BatchNormLayer>(&layer)) norm->options.momentum = momentum;
    changed.add(node.name, std::move(layer), node.inputs);
  }
  return changed;
}

/// The momentum of step t. The moving statistics start as the plain mean over the first batches, because those of an
/// untrained network mean nothing.
double momentum_at(std::int64_t t) { return std::min(static_cast<double>(t) / static_cast<double>(t + 1), 0.95); }

/// Sums over images: of their losses, and of those that are recognised.
struct ImageSums {
  double loss = 0;
  Index right = 0;
};

ImageSums step(const Graph& described, Parameters& parameters, Optimizer& optimizer, const LabelledImages::Batch& batch,
               double rate, const PretrainingOptions& options) {
  const Graph graph = with_momentum(described, momentum_at(optimizer.steps));
  const auto loss = [&](const Tensor& logits) { return ops::softmax_cross_entropy(logits, batch.classes); };
  const StepResult result = training_step(graph, parameters, optimizer, {batch.pixels}, loss,
                                          {.task = "pretraining",
                                           .learning_rate = rate,
                                           .seed = options.seed,
                                           .convolution = options.inference.convolution});
  return {result.loss * static_cast<double>(batch.classes.size()), recognised(result.output, batch.classes)};
}

}  // namespace

Pretrained pretrain(const ViewDataset& dataset, const PretrainingOptions& options, const Messages& messages) {
  const models::BackboneKind& kind = models::backbone_kind(options.backbone);
  const ImageSplit parts = split_images(dataset, options);
  const LabelledImages training(dataset, parts.training, kind.preprocessing, messages, "reading images");
  const LabelledImages validation(dataset, parts.validation, kind.preprocessing, messages, "reading validation images");

  const Graph whole = kind.graph(kind.preprocessing.height, false);
  const NodeId pooled = output_layer(kind, whole, "");
  const Graph layers = whole.up_to(pooled);
  Graph head;
  const NodeId features = head.input("features", {element_count(layers.node(pooled).shape)});
  head.add("logits", DenseLayer{.units = static_cast<Index>(parts.categories.size())}, {features});
  const Graph graph = models::trained_graph(layers, layers.inputs().at(0), layers.output(), head);
  Parameters backbone = initial_parameters(layers, options.seed);
  Parameters parameters = models::trained_parameters(graph, backbone, head, options.seed);

  const Index per_epoch = batch_count(options.batch_size, training.size());
  const Index warm_up = std::min(per_epoch, options.epochs * per_epoch / 10);
  const Schedule schedule{.kind = Schedule::Kind::cosine,
                          .base = options.learning_rate,
                          .total = options.epochs * per_epoch - warm_up,
                          .warm_up = warm_up};
  const auto optimizer = adam(trainable(graph, parameters), {.weight_decay = options.weight_decay});
  Progress progress(messages, "pretraining", options.epochs * per_epoch);
  double validation_accuracy = std::numeric_limits<double>::quiet_NaN();
  for (Index epoch = 0; epoch < options.epochs; ++epoch) {
    const auto order = epoch_order(training.size(), options.seed, epoch);
    ImageSums sum;
    for (Index begin = 0, end; begin < training.size(); begin = end) {
      end = batch_end(begin, options.batch_size, training.size());
      const auto indices =
          std::span(order).subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
      const ImageSums batch = step(graph, parameters, *optimizer,
                                   training.augmented_batch(indices, options.augmentation, options.seed, epoch),
                                   schedule.at(optimizer->steps), options);
      sum.loss += batch.loss;
      sum.right += batch.right;
      progress.update(optimizer->steps);
    }
    for (const auto& [name, parameter] : parameters.items())
      check(is_finite(parameter), "[pretraining] ", name, " is not finite after epoch ", epoch + 1,
            "; a smaller learning rate may help");
    const auto count = static_cast<double>(training.size());
    if (validation.size() > 0) validation_accuracy = accuracy(graph, parameters, validation, options.inference);
    if (messages.line)
      messages.line(
          joined("epoch ", epoch + 1, "/", options.epochs, ": loss ", sum.loss / count, ", recognised ",
                 percent(static_cast<double>(sum.right) / count),
                 validation.size() > 0 ? joined(", of unseen objects ", percent(validation_accuracy)) : std::string()));
  }
  Parameters dropped;
  models::take_trained(parameters, backbone, dropped);
  return {models::Backbone(kind, layers, backbone, "", options.inference), parts.categories, training.size(),
          validation.size(), validation_accuracy};
}

}  // namespace svnet::train
