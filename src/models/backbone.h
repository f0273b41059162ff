#pragma once
#include <memory>
#include <span>
#include <string>

#include "image/image.h"
#include "models/registry.h"
#include "nn/graph/parameters.h"
#include "nn/runtime/inference.h"

namespace svnet::models {

/// A backbone up to the layer that gives the features, with its parameters. Safe to share between threads.
class Backbone {
 public:
  /// `graph` as kind.graph makes it, `layer` as output_layer takes it. Layers above that one and their parameters are
  /// not kept, and need not be given. Throws Error if the graph has no such layer.
  Backbone(const BackboneKind& kind, const Graph& graph, const Parameters& parameters, const std::string& layer = "",
           const InferenceOptions& options = {});

  const BackboneKind& kind() const { return *kind_; }
  const Graph& graph() const { return graph_; }
  /// The name of the layer that gives the features, and their number D.
  const std::string& output_name() const { return graph_.node(graph_.output()).name; }
  Index dimension() const { return element_count(graph_.node(graph_.output()).shape); }
  const Parameters& parameters() const { return parameters_; }
  const Preprocessing& preprocessing() const { return kind_->preprocessing; }
  /// The compiled graph.
  const Inference& network() const { return *inference_; }

  /// Features (N, D) of a preprocessed batch (N, H, W, 3).
  Tensor features(const Tensor& batch) const;
  /// Resizes and preprocesses images of any size into a batch (N, H, W, 3).
  Tensor batch(std::span<const Image> images) const;

 private:
  const BackboneKind* kind_;
  Graph graph_;
  Parameters parameters_{};
  std::shared_ptr<const Inference> inference_{};
};

/// The backbone with seeded random weights. It has the layers of the top only if `layer` is one of them.
Backbone random_backbone(const std::string& name, const std::string& layer, std::uint64_t seed,
                         const InferenceOptions& options = {});

/// The backbone with products in int8, for activations within `ranges`.
Backbone in_int8(const Backbone& backbone, std::shared_ptr<const ActivationRanges> ranges);
/// The same for activations as seeded noise makes them: to see and time what int8 does without pictures.
Backbone in_int8_for_noise(const Backbone& backbone, std::uint64_t seed);

}  // namespace svnet::models
