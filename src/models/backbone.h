#pragma once
#include <memory>
#include <span>
#include <string>

#include "models/image/image.h"
#include "models/registry.h"
#include "nn/graph/parameters.h"
#include "nn/runtime/inference.h"

namespace svnet {

/// A backbone cut at the layer whose output are the features, with its numbers. Safe to share between threads.
class Backbone {
 public:
  /// `graph` as kind.graph made it. `layer` as output_layer takes it. Throws Error where the graph has no such layer.
  Backbone(const BackboneKind& kind, Graph graph, Parameters parameters, const std::string& layer = "");

  const BackboneKind& kind() const { return *kind_; }
  const Graph& graph() const { return graph_; }
  /// The name of the layer whose output are the features, and their number D.
  const std::string& output_name() const { return graph_.node(output_).name; }
  Index dimension() const { return element_count(graph_.node(output_).shape); }
  const Parameters& parameters() const { return parameters_; }
  const Preprocessing& preprocessing() const { return kind_->preprocessing; }

  /// Features (N, D) of a batch (N, H, W, 3) that has been preprocessed.
  Tensor features(const Tensor& batch) const;
  /// Resizes and preprocesses pictures of any size into a batch (N, H, W, 3).
  Tensor batch(std::span<const Image> images) const;

 private:
  const BackboneKind* kind_;
  Graph graph_;
  Parameters parameters_;
  NodeId output_;
  std::shared_ptr<const Inference> inference_;  // what runs
};

/// The backbone with seeded random weights and no top.
Backbone random_backbone(const std::string& name, const std::string& layer, std::uint64_t seed);

}  // namespace svnet
