#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "nn/graph/parameters.h"

namespace svnet {

/// A training run between two epochs: all that going on needs.
struct Checkpoint {
  std::string input_fingerprint;  // of everything that the run depends on
  Index epoch = 0;                // epochs done
  Index steps = 0;                // optimizer steps done
  double best_loss = 0;           // of the best epoch so far
  std::string metrics;            // metrics.csv so far
  Parameters parameters;          // of the trained graph (models/trained_graph.h)
  std::vector<Tensor> optimizer;  // its state
};

// A TensorFile of kind "checkpoint": tensors "<layer>/<parameter>" and "optimizer/<number>"; the other members are
// in the description.

/// Replaces the file as a whole.
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

/// The parameters must be those of `graph`; the optimizer's state has the shapes `optimizer`. Throws Error that
/// names the file and what is wrong with it.
Checkpoint read_checkpoint(const std::filesystem::path& path, const Graph& graph, const std::vector<Shape>& optimizer);

/// The parameters alone: the optimizer's state, which may be twice as large, is not read.
Parameters read_checkpoint_parameters(const std::filesystem::path& path, const Graph& graph);

/// The fingerprint alone; empty where the file does not exist. Throws Error where it is no checkpoint.
std::string read_checkpoint_fingerprint(const std::filesystem::path& path);

}  // namespace svnet
