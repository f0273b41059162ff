#pragma once
#include <memory>
#include <span>
#include <string>

#include "image/image.h"
#include "models/registry.h"
#include "nn/graph/parameters.h"
#include "nn/runtime/inference.h"

namespace svnet {

/// A backbone cut at the layer whose output are the features, with its numbers. Safe to share between threads.
class Backbone {
 public:
  /// `graph` as kind.graph made it; layers above the output, and their parameters, are not kept and need not be given.
  /// `layer` as output_layer takes it. Throws Error where the graph has no such layer.
  Backbone(const BackboneKind& kind, const Graph& graph, const Parameters& parameters, const std::string& layer = "");

  const BackboneKind& kind() const { return *kind_; }
  const Graph& graph() const { return graph_; }
  /// The name of the layer whose output are the features, and their number D.
  const std::string& output_name() const { return graph_.node(graph_.output()).name; }
  Index dimension() const { return element_count(graph_.node(graph_.output()).shape); }
  const Parameters& parameters() const { return parameters_; }
  const Preprocessing& preprocessing() const { return kind_->preprocessing; }
  /// What runs.
  const Inference& network() const { return *inference_; }

  /// Features (N, D) of a batch (N, H, W, 3) that has been preprocessed.
  Tensor features(const Tensor& batch) const;
  /// Resizes and preprocesses pictures of any size into a batch (N, H, W, 3).
  Tensor batch(std::span<const Image> images) const;

 private:
  const BackboneKind* kind_;
  Graph graph_;
  Parameters parameters_{};
  std::shared_ptr<const Inference> inference_{};
};

/// The backbone with seeded random weights, with the layers of its top only where `layer` is one of them.
Backbone random_backbone(const std::string& name, const std::string& layer, std::uint64_t seed);

}  // namespace svnet
