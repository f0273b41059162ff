#pragma once
#include <map>
#include <string>
#include <vector>

#include "nn/runtime/activation_ranges.h"
#include "nn/runtime/inference.h"

namespace svnet {

/// Finds the ranges of a network's activations by running it in f32.
class Calibration {
 public:
  Calibration(const Graph& graph, const Parameters& parameters, NodeId output);

  /// Runs a batch. Throws Error if it is empty, or if it is not finite.
  void add(const Tensor& batch);

  /// Over all batches so far. Throws Error if there was none, and if an activation was not finite.
  ActivationRanges ranges() const;

 private:
  /// Of the channels that a layer multiplies.
  struct Seen {
    std::vector<float> low{}, high{};
    std::vector<double> sum{};
    Index rows = 0;

    void add(Index count, const kernels::PanelRows& a, Index channels);
  };

  Inference network_;
  std::map<std::string, Seen> seen_{};
};

}  // namespace svnet
