#include "models/backbone.h"

#include "base/parallel.h"

namespace svnet {

Backbone::Backbone(const BackboneKind& kind, Graph graph, Parameters parameters, const std::string& layer)
    : kind_(&kind),
      graph_(std::move(graph)),
      parameters_(std::move(parameters)),
      output_(output_layer(kind, graph_, layer)),
      inference_(std::make_shared<Inference>(graph_, parameters_, output_)) {}

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

Backbone random_backbone(const std::string& name, const std::string& layer, std::uint64_t seed) {
  const BackboneKind& kind = backbone_kind(name);
  Graph graph = kind.graph(kind.preprocessing.height, false);
  Parameters parameters = initial_parameters(graph, seed);
  return {kind, std::move(graph), std::move(parameters), layer};
}

}  // namespace svnet
