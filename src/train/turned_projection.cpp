#include "train/turned_projection.h"

#include <algorithm>

#include "base/error.h"
#include "frame/turns.h"
#include "models/turned_backbone.h"
#include "nn/runtime/inference.h"
#include "train/turned_features.h"

namespace svnet::train {
namespace {

constexpr const char* kKernel = "projection/kernel";
constexpr const char* kBias = "projection/bias";

/// The features of a pose at the azimuth of every turn: (kTurns, dimension).
void append_seen(const float* turned, Index dimension, std::vector<float>& rows) {
  std::vector<double> sum(static_cast<std::size_t>(dimension));
  for (const frame::Turn& turn : frame::turns()) {
    std::fill(sum.begin(), sum.end(), 0.0);
    const auto weights = frame::turn_weights({.theta_deg = turn.theta_deg, .phi_deg = 0});
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (weights[i] == 0) continue;
      const float* values = turned + static_cast<Index>(i) * dimension;
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weights[i] * static_cast<double>(values[k]);
    }
    for (const double value : sum) rows.push_back(static_cast<float>(value));
  }
}

}  // namespace

PrincipalComponents turned_components(const ViewDataset& dataset, const Features& turned,
                                      const std::vector<bool>& categories, std::uint64_t seed, Parallel& parallel) {
  check_turned_rows(dataset, turned);
  std::vector<float> rows;
  for (std::size_t pose = 0; pose < dataset.poses.size(); ++pose)
    if (categories[static_cast<std::size_t>(dataset.poses[pose].category)])
      append_seen(turned.values.data() + static_cast<Index>(pose) * frame::kTurns * turned.dimension, turned.dimension,
                  rows);
  return principal_components(rows, turned.dimension, kTurnedComponents, seed, parallel);
}

void set_turned_backbone(Model& model, const models::Backbone& backbone, const PrincipalComponents& components) {
  model.backbone = backbone.kind().name;
  model.preprocessing = backbone.preprocessing();
  model.backbone_graph = models::projected_graph(models::pooled_graph(backbone.graph()), components.components);
  model.backbone_output = model.backbone_graph.node(model.backbone_graph.output()).name;
  model.backbone_parameters = backbone.parameters();
  model.backbone_ranges = backbone.network().options().ranges;
  const auto k = static_cast<std::size_t>(components.components);
  Tensor kernel = Tensor::empty({components.inputs, components.components}),
         bias = Tensor::empty({components.components});
  std::vector<double> of_mean(k);
  for (std::size_t i = 0; i < components.directions.size(); ++i) {
    kernel.data<float>()[i] = static_cast<float>(components.directions[i]);
    of_mean[i % k] += components.mean[i / k] * components.directions[i];
  }
  std::transform(of_mean.begin(), of_mean.end(), bias.data<float>(),
                 [](double value) { return static_cast<float>(-value); });
  model.backbone_parameters.set(kKernel, kernel);
  model.backbone_parameters.set(kBias, bias);
}

std::vector<float> projected_turns(const Model& model, const Features& turned, const InferenceOptions& inference) {
  const Tensor& kernel = model.backbone_parameters.at(kKernel);
  const Index inputs = kernel.dim(0), components = kernel.dim(1);
  check(turned.dimension == inputs, "[turned] features have ", turned.dimension, " values, the projection takes ",
        inputs);
  Parameters parameters;
  for (const char* name : {kKernel, kBias}) parameters.set(name, model.backbone_parameters.at(name));
  const Graph graph = models::projection_graph(inputs, components);
  const Inference projection(graph, parameters, graph.output(), inference);
  std::vector<float> values(static_cast<std::size_t>(turned.count * components));
  constexpr Index kRows = 256;
  for (Index begin = 0; begin < turned.count; begin += kRows) {
    const Index size = std::min(kRows, turned.count - begin);
    Tensor rows = Tensor::empty({size, inputs});
    std::copy_n(turned.values.data() + begin * inputs, rows.size(), rows.data<float>());
    const Tensor projected = projection.run({rows});
    std::copy_n(projected.data<float>(), projected.size(), values.data() + begin * components);
  }
  return values;
}

}  // namespace svnet::train
