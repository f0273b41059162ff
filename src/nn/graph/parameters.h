#pragma once
#include <map>
#include <string>
#include <vector>

#include "nn/graph/graph.h"

namespace svnet {

/// The parameters of a graph by name ("layer/kernel"), in the order in which they were set.
class Parameters {
 public:
  void set(const std::string& name, Tensor value);
  bool contains(const std::string& name) const { return index_.count(name) != 0; }
  /// Throws Error if there is none of that name.
  Tensor& at(const std::string& name);
  const Tensor& at(const std::string& name) const;
  const std::vector<std::pair<std::string, Tensor>>& items() const { return items_; }

 private:
  std::map<std::string, std::size_t> index_;
  std::vector<std::pair<std::string, Tensor>> items_;
};

/// Every parameter of the graph as its initialiser draws it. Trainable ones are leaves of the tape.
Parameters initial_parameters(const Graph& graph, std::uint64_t seed, DType dtype = DType::f32);

/// The trainable parameters, in the order of the graph.
std::vector<Tensor> trainable(const Graph& graph, const Parameters& parameters);

}  // namespace svnet
