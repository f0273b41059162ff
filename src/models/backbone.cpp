#include "models/backbone.h"

#include "base/parallel.h"
#include "base/random.h"
#include "nn/runtime/calibration.h"

namespace svnet::models {

Backbone::Backbone(const BackboneKind& kind, const Graph& graph, const Parameters& parameters, const std::string& layer,
                   const InferenceOptions& options)
    : kind_(&kind), graph_(graph.up_to(output_layer(kind, graph, layer))) {
  for (const GraphNode& node : graph_.nodes())
    for (const ParameterSpec& spec : node.parameters)
      parameters_.set(node.parameter_name(spec), parameters.at(node.parameter_name(spec)));
  inference_ = std::make_shared<Inference>(graph_, parameters_, graph_.output(), options);
}

Tensor Backbone::features(const Tensor& batch) const {
  return inference_->run({batch}).reshaped({batch.dim(0), dimension()});
}

Tensor Backbone::batch(std::span<const Image> images) const {
  const Preprocessing& how = kind_->preprocessing;
  Tensor batch = Tensor::empty({static_cast<Index>(images.size()), how.height, how.width, 3});
  Parallel::shared().for_chunks(static_cast<Index>(images.size()), 1, [&](Index i, Index, int) {
    prepare(how, images[static_cast<std::size_t>(i)], batch.data<float>() + i * how.size());
  });
  return batch;
}

Backbone random_backbone(const std::string& name, const std::string& layer, std::uint64_t seed,
                         const InferenceOptions& options) {
  const BackboneKind& kind = backbone_kind(name);
  const Graph whole = kind.graph(kind.preprocessing.height, true);
  const Graph graph = whole.up_to(output_layer(kind, whole, layer));
  return {kind, graph, initial_parameters(graph, seed), layer, options};
}

Backbone in_int8(const Backbone& backbone, std::shared_ptr<const ActivationRanges> ranges) {
  return {backbone.kind(),
          backbone.graph(),
          backbone.parameters(),
          backbone.output_name(),
          {.precision = kernels::Precision::int8, .ranges = std::move(ranges)}};
}

Backbone in_int8_for_noise(const Backbone& backbone, std::uint64_t seed) {
  const Preprocessing& how = backbone.preprocessing();
  Tensor batch = Tensor::empty({1, how.height, how.width, 3});
  RandomStream noise(seed, Stream::weights, 1);
  for (Index i = 0; i < batch.size(); ++i)
    batch.data<float>()[i] = static_cast<float>(noise.bits32() >> 8) * 0x1p-23f - 1.0f;
  Calibration calibration(backbone.graph(), backbone.parameters(), backbone.graph().output());
  calibration.add(batch);
  return in_int8(backbone, std::make_shared<ActivationRanges>(calibration.ranges()));
}

}  // namespace svnet::models
