#include "io/models/checkpoint.h"

#include <nlohmann/json.hpp>

#include "io/tensors/tensor_file.h"

namespace svnet::io {

void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint) {
  TensorFile file;
  file.description() = {{"kind", "checkpoint"},
                        {"input_fingerprint", checkpoint.input_fingerprint},
                        {"epoch", checkpoint.epoch},
                        {"steps", checkpoint.steps},
                        {"steps_in_epoch", checkpoint.steps_in_epoch},
                        {"loss_sum", checkpoint.loss_sum},
                        {"best_loss", checkpoint.best_loss},
                        {"best_epoch", checkpoint.best_epoch},
                        {"metrics", checkpoint.metrics}};
  file.add("", checkpoint.parameters);
  for (std::size_t i = 0; i < checkpoint.optimizer.size(); ++i)
    file.add("optimizer/" + std::to_string(i), checkpoint.optimizer[i]);
  file.write(path);
}

Checkpoint read_checkpoint(const std::filesystem::path& path, const Graph& graph, const std::vector<Shape>& optimizer) {
  const TensorFile file = TensorFile::read(path, "checkpoint");
  Checkpoint checkpoint{.input_fingerprint = file.get<std::string>("input_fingerprint"),
                        .epoch = file.get<Index>("epoch"),
                        .steps = file.get<Index>("steps"),
                        .steps_in_epoch = file.get<Index>("steps_in_epoch"),
                        .loss_sum = file.get<double>("loss_sum"),
                        .best_loss = file.get<double>("best_loss"),
                        .best_epoch = file.get<Index>("best_epoch"),
                        .metrics = file.get<std::string>("metrics"),
                        .parameters = file.parameters("", graph),
                        .optimizer = {}};
  for (std::size_t i = 0; i < optimizer.size(); ++i)
    checkpoint.optimizer.push_back(file.at("optimizer/" + std::to_string(i), optimizer[i]));
  return checkpoint;
}

Parameters read_checkpoint_parameters(const std::filesystem::path& path, const Graph& graph) {
  return TensorFile::read(path, "checkpoint", "optimizer/").parameters("", graph);
}

std::string read_checkpoint_fingerprint(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return {};
  return TensorFile::read(path, "checkpoint", "optimizer/").get<std::string>("input_fingerprint");
}

}  // namespace svnet::io
