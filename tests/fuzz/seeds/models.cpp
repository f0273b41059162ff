// Model files as small as they can be, one for each frame, and the tables of features and scores.
#include <nlohmann/json.hpp>

#include "io/tensors/safetensors.h"
#include "io/views/features_file.h"
#include "io/views/scores_file.h"
#include "models/sv_net.h"
#include "seeds.h"
#include "small_model.h"
#include "view/symmetry.h"

namespace svnet::fuzz {
namespace {

/// Two layers on images of 12 x 12 pixels.
Graph small_backbone(const std::string& output) {
  Graph graph;
  const NodeId image = graph.input("image", {12, 12, 3});
  const NodeId conv =
      graph.add("conv", Conv2dLayer{.filters = 2, .kh = 3, .kw = 3, .stride_h = 2, .stride_w = 2}, {image});
  graph.add(output, BatchNormLayer{}, {conv});
  return graph;
}

Model tiny_camera_model(models::AngleEncoding angles, int symmetries) {
  Model model;
  model.backbone = "tiny";
  model.backbone_output = "out";
  model.preprocessing.height = model.preprocessing.width = 12;
  model.backbone_graph = small_backbone("out");
  model.backbone_parameters = initial_parameters(model.backbone_graph, 1);
  model.angles = angles;
  model.symmetries = symmetries;
  const Shape& features = model.backbone_graph.node(model.backbone_graph.output()).shape;
  model.head = models::sv_net({.features = element_count(features), .width = 3, .dropout = 0.5, .angles = angles});
  model.head_parameters = initial_parameters(model.head, 2);
  model.input_fingerprint = "seed";
  model.trained_on = {{"ball", "cube"}, 3, 4};
  model.held_out = {{"ring"}, 40, {{"tiny_ward", "sv_net", "fm", 0.5, 0.1}}};
  return model;
}

Model tiny_turned_model() {
  Model model;
  model.frame = frame::FrameChoice::turned;
  model.backbone = "tiny";
  model.backbone_output = "projection";
  model.preprocessing.height = model.preprocessing.width = 12;
  const Graph pooled = models::pooled_graph(small_backbone("out"));
  model.backbone_graph = models::projected_graph(pooled, 2);
  model.backbone_parameters = initial_parameters(model.backbone_graph, 3);
  set_small_head(model);
  model.input_fingerprint = "seed";
  return model;
}

/// What the target model_description reads: the description, and a line for each tensor.
void add_description(const Seeds& seeds, const std::string& name, const std::filesystem::path& path) {
  const io::SafetensorsFile file(path);
  nlohmann::json description = nlohmann::json::parse(file.metadata().at("svnet"));
  description.erase("checksums");
  std::string text = description.dump() + "\n%%\n";
  for (const io::SafetensorsTensor& tensor : file.tensors()) {
    text += tensor.name;
    for (const Index size : tensor.shape) text += " " + std::to_string(size);
    text += "\n";
  }
  seeds.add("model_description", name, text);
}

void add_model(const Seeds& seeds, const std::string& name, Model model) {
  for (const StoredPrecision precision : {StoredPrecision::f32, StoredPrecision::bf16, StoredPrecision::int8}) {
    model.precision = precision;
    const auto path = seeds.path("c_api", name + "_" + std::string(name_of(precision)));
    io::write_model(path, model);
    if (precision == StoredPrecision::f32) {
      add_description(seeds, name, path);
      std::filesystem::copy_file(path, seeds.path("safetensors", name));
    }
  }
}

Model with_numbers(Model model) {
  const auto count = static_cast<std::size_t>(frame::shape_number_count(frame_spec(model)));
  model.seen = {std::vector<double>(count, 0.5), std::vector<double>(count, 1.5), 3};
  model.gain = {0.1, 0.2, {-1, 0, 1}};
  return model;
}

void add_tables(const Seeds& seeds) {
  Features features;
  features.backbone = "tiny";
  features.count = 2;
  features.dimension = 3;
  features.values = {1, 2, 3, 4, 5, 6};
  features.theta_phi_deg = {{{0, 45}, {90, 90}}};
  features.paths = {"a/b/1/45_0.png", "a/b/1/90_90.png"};
  io::write_features(seeds.path("hdf5_tables", "features"), features);
  Scores scores;
  scores.problems = 4;
  scores.clustering = "ward";
  scores.individual = scores.global = scores.scaled = {0.5, 1};
  scores.count = {1, 4};
  scores.standard_error = {0, 0.1};
  scores.rank_stability = {0, 1};
  scores.paths = features.paths;
  io::write_scores(seeds.path("hdf5_tables", "scores"), scores);
  io::write_scores_snapshot(seeds.path("hdf5_tables", "snapshot"), {"seed", 3, 2, {1, 2, 3, 4}});
  seeds.copy("hdf5_tables", "io", ".h5");
  seeds.copy("keras", "io", ".h5");
  for (const char* word : {"OHDR",          "OCHK",
                           "TREE",          "HEAP",
                           "SNOD",          "GCOL",
                           "FRHP",          "FHDB",
                           "FHIB",          "BTHD",
                           "BTLF",          "BTIN",
                           "FSHD",          "\x89HDF\r\n\x1a\n",
                           "layer_names",   "weight_names",
                           "model_weights", "layers",
                           "vars",          "\xff\xff\xff\xff\xff\xff\xff\xff"})
    for (const char* target : {"keras", "hdf5_tables"}) seeds.add_word(target, word);
}

}  // namespace

void add_models(const Seeds& seeds) {
  add_model(seeds, "radians", tiny_camera_model(models::AngleEncoding::radians, 1));
  add_model(seeds, "harmonics", tiny_camera_model(models::AngleEncoding::harmonics, view::kSymmetries));
  add_model(seeds, "axis", with_numbers(small_axis_model()));
  add_model(seeds, "depth", with_numbers(small_axis_model(frame::DepthChoice::heights)));
  add_model(seeds, "turned", tiny_turned_model());
  seeds.copy("safetensors", "io", ".safetensors");
  for (const char* target : {"c_api", "model_description", "safetensors"})
    for (const char* word : {"\"F32\"",
                             "\"BF16\"",
                             "\"I8\"",
                             "\"dtype\"",
                             "\"shape\"",
                             "\"data_offsets\"",
                             "__metadata__",
                             "\\\"frame\\\"",
                             "\"kind\"",
                             "\"inputs\"",
                             "\"name\"",
                             "\"Conv2D\"",
                             "\"DepthwiseConv2D\"",
                             "\"SeparableConv2D\"",
                             "\"Dense\"",
                             "\"Flatten\"",
                             "\"Reshape\"",
                             "\"Add\"",
                             "\"Multiply\"",
                             "\"Concatenate\"",
                             "\"MaxPooling2D\"",
                             "\"GlobalAveragePooling2D\"",
                             "\"ZeroPadding2D\"",
                             "\"BatchNormalization\"",
                             "\"Activation\"",
                             "\"Dropout\"",
                             "\"padding\"",
                             "\"same\"",
                             "\"valid\"",
                             "\"pool\"",
                             "\"filters\"",
                             "\"orientations\"",
                             "\"seen\"",
                             "\"gain\"",
                             "9223372036854775807",
                             "-1",
                             "4294967296",
                             "1e308",
                             ".scale"})
      seeds.add_word(target, word);
  add_tables(seeds);
}

}  // namespace svnet::fuzz
