#pragma once
#include "nn/runtime/activation_ranges.h"
#include "nn/runtime/inference.h"

namespace svnet {

/// Finds the ranges of a network's activations by running it in f32.
class Calibration {
 public:
  Calibration(const Graph& graph, const Parameters& parameters, NodeId output);

  /// Runs a batch. Throws Error if it is empty, or if it or an activation is not finite.
  void add(const Tensor& batch);

  /// Over all batches so far. Throws Error if there was none.
  ActivationRanges ranges() const;

 private:
  struct Sums;

  Inference network_;
  std::map<std::string, kernels::ChannelRanges> sums_{};  // `mean` holds sums
  std::map<std::string, Index> rows_{};                   // that were summed
};

}  // namespace svnet
