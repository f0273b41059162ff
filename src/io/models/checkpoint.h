#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "nn/graph/parameters.h"

namespace svnet::io {

/// The state of training after an epoch, or within one: everything that resuming needs.
struct Checkpoint {
  std::string input_fingerprint;  // of everything that training depends on
  Index epoch = 0;                // number of finished epochs
  Index steps = 0;                // number of optimizer steps so far
  Index steps_in_epoch = 0;       // of them, those of an epoch that is not finished
  double loss_sum = 0;            // over the examples of that epoch so far
  double best_loss = 0;           // of the best epoch so far: 1 - Spearman on validation categories, or training loss
  Index best_epoch = 0;           // that epoch, from 1 on
  std::string metrics;            // the contents of metrics.csv so far
  Parameters parameters;          // of the trained graph (models/trained_graph.h)
  std::vector<Tensor> optimizer;  // the optimizer's state (nn/optim/optimizer.h)
};

// The file is a TensorFile of kind "checkpoint" with the tensors "<layer>/<parameter>" and "optimizer/<index>". Its
// description has the other members.

/// Replaces the file as a whole.
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

/// Throws Error that names the file and the tensor unless it has the parameters of `graph` and an optimizer's state
/// with the shapes `optimizer`.
Checkpoint read_checkpoint(const std::filesystem::path& path, const Graph& graph, const std::vector<Shape>& optimizer);

/// Reads only the parameters. The optimizer's state, which can be twice as large, is skipped.
Parameters read_checkpoint_parameters(const std::filesystem::path& path, const Graph& graph);

/// Reads only the fingerprint; empty if the file does not exist. Throws Error for a file that is not a checkpoint.
std::string read_checkpoint_fingerprint(const std::filesystem::path& path);

}  // namespace svnet::io
