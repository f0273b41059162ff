#include "workplace.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <sstream>

#include "io/hdf5/hdf5_file.h"
#include "nn/graph/keras_order.h"
#include "small_dataset.h"
#include "small_model.h"

namespace svnet {
using namespace io;
using namespace models;

namespace {

constexpr const char* kConfig = R"(seed: 3
dataset:
  root: data
  held_out: [ring]
weights:
  folder: weights
scores:
  backbone: tiny_xception
  problems: 300
  min_categories: 2
sv_net:
  backbone: tiny_xception
  width: 16
training:
  epochs: 2
  batch_size: 5
evaluation:
  problems: 40
  pipelines: [tiny_xception_ward]
)";

}  // namespace

Workplace::Workplace() {
  write_small_dataset(folder_.path() / "data");
  std::filesystem::create_directory(folder_.path() / "weights");
  write_tiny_weights(folder_.path() / "weights" / "tiny_xception.h5");
  folder_.write("config.yaml", kConfig);
  folder_.write("poses.csv", "theta,phi\n0,45\n90,60\n200.5,75\n90,90\n");
  write_png(folder_.path() / "top.png", small_image());
  write_model(folder_.path() / "model.safetensors", small_model());
  output_of(
      "svnet-features --quiet --backbone tiny_xception --weights weights/tiny_xception.h5 --images data "
      "--output features.h5");
  output_of("svnet-score --quiet --features features.h5 --dataset data --output scores.h5 --problems 300");
}

Ran Workplace::run(const std::string& command) const {
  return run_shell(folder_.path(), "export PATH=" PROGRAMS ":$PATH && { " + command + "; }");
}

std::string Workplace::output_of(const std::string& command) const {
  const Ran ran = run(command);
  INFO(command << "\n" << ran.err);
  REQUIRE(ran.status == 0);
  REQUIRE(ran.err.empty());
  return ran.out;
}

std::set<std::string> Workplace::entries() const {
  std::set<std::string> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path()))
    found.insert(entry.path().lexically_relative(folder_.path()));
  return found;
}

void write_tiny_weights(const std::filesystem::path& path, bool swapped) {
  const Backbone backbone = random_backbone("tiny_xception", "", 6);
  const Graph& graph = backbone.graph();
  std::vector<std::string> names;
  Hdf5File file = Hdf5File::create(path);
  for (const NodeId id : keras_order(graph, graph.find(backbone.output_name()))) {
    const GraphNode& node = graph.node(id);
    if (node.parameters.empty()) continue;
    names.push_back(node.name);
    std::vector<std::string> arrays;
    for (const ParameterSpec& spec : node.parameters) {
      arrays.push_back(node.parameter_name(spec));
      const auto values = backbone.parameters().at(arrays.back()).values<float>();
      file.write<float>(node.name + "/" + arrays.back(), {spec.shape.begin(), spec.shape.end()},
                        {values.data(), values.size()});
    }
    file.write_text_list_attribute(node.name, "weight_names", arrays);
  }
  if (swapped)
    std::iter_swap(std::find(names.begin(), names.end(), "block2_sepconv1_bn"),
                   std::find(names.begin(), names.end(), "block2_sepconv2_bn"));
  file.write_text_list_attribute("", "layer_names", names);
  file.close();
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace svnet
