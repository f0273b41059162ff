#include "models/backbone.h"

#include "base/parallel.h"

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

}  // namespace svnet::models
