#include "nn/graph/parameters.h"

namespace svnet {

void Parameters::set(const std::string& name, Tensor value) {
  const auto [at, inserted] = index_.try_emplace(name, items_.size());
  if (inserted)
    items_.emplace_back(name, std::move(value));
  else
    items_[at->second].second = std::move(value);
}

Tensor& Parameters::at(const std::string& name) {
  const auto found = index_.find(name);
  check(found != index_.end(), "[parameters] there is no '", name, "'");
  return items_[found->second].second;
}

const Tensor& Parameters::at(const std::string& name) const {
  return const_cast<Parameters*>(this)->at(name);  // NOLINT: the lookup changes nothing
}

Parameters initial_parameters(const Graph& graph, std::uint64_t seed, DType dtype) {
  Parameters parameters;
  std::uint32_t number = 0;
  for (const auto& node : graph.nodes())
    for (const auto& spec : node.parameters) {
      Tensor value = initialised(spec.initializer, spec.shape, seed, number++, dtype);
      parameters.set(node.parameter_name(spec), spec.trainable ? value.as_parameter() : value);
    }
  return parameters;
}

std::vector<Tensor> trainable(const Graph& graph, const Parameters& parameters) {
  std::vector<Tensor> tensors;
  for (const auto& node : graph.nodes())
    for (const auto& spec : node.parameters)
      if (spec.trainable) tensors.push_back(parameters.at(node.parameter_name(spec)));
  return tensors;
}

}  // namespace svnet
