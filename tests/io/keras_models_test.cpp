// Backbones inside the files that people train with Keras. The files are written here in Keras' layouts;
// tests/oracle/test_keras_models.py does the same with Keras itself.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <utility>

#include "base/error.h"
#include "io/hdf5/hdf5_file.h"
#include "io/keras/keras_graph.h"
#include "io/keras/snake_case.h"
#include "models/registry.h"
#include "nn/graph/keras_order.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
using namespace svnet::models;
using Catch::Contains;

namespace {

struct Array {
  std::string name;  // "gamma"
  Shape shape;
  std::vector<float> values;
  bool trainable = true;
};
struct NamedLayer {
  std::string name, class_name;
  std::vector<Array> arrays;
};
using Texts = std::vector<std::string>;

std::string class_of(const GraphNode& node) {
  static const std::map<std::string, std::string> kNames{{"Conv2D", "conv2d"},
                                                         {"DepthwiseConv2D", "depthwise_conv2d"},
                                                         {"BatchNormalization", "batch_normalization"},
                                                         {"Dense", "dense"}};
  return kNames.at(keras_name(node.layer));
}

/// The layers of a network with weights, in the order of Keras. No two values of the first array of layers are equal.
std::vector<NamedLayer> layers_of(const std::string& network, bool top) {
  const BackboneKind& kind = backbone_kind(network);
  const Graph graph = kind.graph(kind.preprocessing.height, top);
  std::vector<NamedLayer> layers;
  float next = 1;
  for (const NodeId id : keras_order(graph, graph.output())) {
    const GraphNode& node = graph.node(id);
    if (node.parameters.empty()) continue;
    layers.push_back({node.name, class_of(node), {}});
    for (const ParameterSpec& spec : node.parameters)
      layers.back().arrays.push_back({spec.name, spec.shape,
                                      std::vector<float>(static_cast<std::size_t>(element_count(spec.shape)), next++),
                                      spec.trainable});
  }
  return layers;
}

NamedLayer dense(const std::string& name, Index inputs, Index units) {
  const auto zeros = [](Index count) { return std::vector<float>(static_cast<std::size_t>(count), 0.0f); };
  return {name, "dense", {{"kernel", {inputs, units}, zeros(inputs * units)}, {"bias", {units}, zeros(units)}}};
}

/// A file in the legacy layout.
class LegacyFile {
 public:
  explicit LegacyFile(const std::filesystem::path& path) : file_(Hdf5File::create(path)) {}

  void add(const NamedLayer& layer) { add_group(layer.name, {layer}, 0); }
  /// A model that is a layer of the model, as Keras lists it: first the arrays that can be trained, then the others.
  /// The first `frozen` layers cannot be trained.
  void add_group(const std::string& name, const std::vector<NamedLayer>& layers, std::size_t frozen) {
    Texts names;
    file_.create_group("model_weights/" + name);
    for (const bool trainable : {true, false})
      for (std::size_t i = 0; i < layers.size(); ++i)
        for (const Array& array : layers[i].arrays) {
          if ((array.trainable && i >= frozen) != trainable) continue;
          names.push_back(layers[i].name + "/" + array.name + ":0");
          file_.write<float>("model_weights/" + name + "/" + names.back(), array.shape, array.values);
        }
    file_.write_text_list_attribute("model_weights/" + name, "weight_names", names);
    layers_.push_back(name);
  }
  void close() {
    file_.write_text_list_attribute("model_weights", "layer_names", layers_);
    file_.close();
  }

 private:
  Hdf5File file_;
  Texts layers_{};
};

/// Adds layers to a file of Keras 3, named by class and counter.
void add_keras3(Hdf5File& file, const std::string& group, const std::vector<NamedLayer>& layers) {
  std::map<std::string, int> counters;
  for (const NamedLayer& layer : layers) {
    const int counter = counters[layer.class_name]++;
    const std::string name = group + "/" + layer.class_name + (counter == 0 ? "" : "_" + std::to_string(counter));
    for (std::size_t i = 0; i < layer.arrays.size(); ++i)
      file.write<float>(joined(name, "/vars/", i), layer.arrays[i].shape, layer.arrays[i].values);
  }
}

/// Checks that the network's weights are those of `layers`, and that the others of the file are listed.
void check_read(const std::string& network, const std::filesystem::path& path, const std::vector<NamedLayer>& layers,
                const Texts& unused, const std::string& output = "") {
  KerasLoadReport report;
  const Backbone backbone = read_keras_backbone(network, path, output, &report);
  std::size_t read = 0;
  for (const NamedLayer& layer : layers)
    for (const Array& array : layer.arrays) {
      if (!backbone.parameters().contains(layer.name + "/" + array.name)) continue;
      INFO(layer.name << "/" << array.name);
      CHECK(std::ranges::equal(backbone.parameters().at(layer.name + "/" + array.name).values<float>(), array.values));
      ++read;
    }
  CHECK(read == backbone.parameters().items().size());
  CHECK(report.unused == unused);
}

}  // namespace

TEST_CASE("a network with another top on it is read, legacy layout") {
  const TemporaryFolder folder;
  const auto layers = layers_of("mobilenet", false);
  LegacyFile file(folder.path() / "tuned.h5");
  for (const auto& layer : layers) file.add(layer);
  file.add(dense("dense", 1024, 5));
  file.close();
  check_read("mobilenet", folder.path() / "tuned.h5", layers, {"dense"});
  check_read("mobilenet", folder.path() / "tuned.h5", layers, {"dense"}, "conv_pw_13_relu");
}

TEST_CASE("a network with another top on it is read, Keras 3") {
  const TemporaryFolder folder;
  auto layers = layers_of("mobilenet", false);
  const auto path = folder.path() / "tuned.weights.h5";
  layers.push_back(dense("dense", 1024, 5));
  Hdf5File file = Hdf5File::create(path);
  add_keras3(file, "layers", layers);
  file.close();
  layers.pop_back();
  check_read("mobilenet", path, layers, {"dense"});
}

TEST_CASE("a whole network is read with its own top, Keras 3") {
  const TemporaryFolder folder;
  const auto layers = layers_of("mobilenet", true);
  const auto path = folder.path() / "whole.weights.h5";
  Hdf5File file = Hdf5File::create(path);
  add_keras3(file, "layers", layers);
  file.close();
  check_read("mobilenet", path, layers, {}, "conv_preds");
}

TEST_CASE("VGG16 with three dense layers of its user is read, and its top as far as it is Keras'") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "tuned.h5";
  const auto layers = layers_of("vgg16", false);
  {
    LegacyFile file(path);
    for (const auto& layer : layers) file.add(layer);
    for (const auto& [name, inputs, units] :
         {std::tuple{"dense", Index{25088}, Index{64}}, {"dense_1", 64, 32}, {"dense_2", 32, 5}})
      file.add(dense(name, inputs, units));
    file.close();
  }
  check_read("vgg16", path, layers, {"dense", "dense_1", "dense_2"});
  CHECK_THROWS_WITH(read_keras_backbone("vgg16", path, "fc1"),
                    Contains("'dense' with 25088x64, 64, the model expects 'fc1' with kernel 25088x4096"));
}

TEST_CASE("a network inside a Sequential is read, whichever of its layers were frozen") {
  const TemporaryFolder folder;
  const auto layers = layers_of("mobilenet", false);
  for (const std::size_t frozen : {std::size_t{0}, std::size_t{10}, layers.size()}) {
    const auto path = folder.path() / "nested.h5";
    LegacyFile file(path);
    file.add_group("mobilenet_1.00_224", layers, frozen);
    file.add_group("global_average_pooling2d", {}, 0);
    file.add(dense("dense", 1024, 5));
    file.close();
    check_read("mobilenet", path, layers, {"dense"});
  }
  const auto path = folder.path() / "nested.weights.h5";
  Hdf5File file = Hdf5File::create(path);
  add_keras3(file, "layers/functional/layers", layers);
  add_keras3(file, "layers", {dense("dense", 1024, 5)});
  file.close();
  check_read("mobilenet", path, layers, {"dense"});
}

TEST_CASE("a multi-GPU wrapper's file is read, its top too") {
  const TemporaryFolder folder;
  const auto layers = layers_of("mobilenet", true);
  const auto path = folder.path() / "parallel.h5";
  LegacyFile file(path);
  for (const char* name : {"input_1", "lambda_1", "lambda_2"}) file.add_group(name, {}, 0);
  file.add_group("mobilenet_1.00_224", layers, 0);
  file.add_group("conv_preds", {}, 0);
  file.close();
  check_read("mobilenet", path, layers, {"mobilenet_1.00_224/conv_preds"});
  check_read("mobilenet", path, layers, {}, "conv_preds");
}

TEST_CASE("two models that fit are refused by their names, and one that does not fit by its layer") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "w.h5";
  auto layers = layers_of("mobilenet", false);
  {
    LegacyFile file(path);
    file.add_group("left", layers, 0);
    file.add_group("right", layers, 0);
    file.close();
  }
  CHECK_THROWS_WITH(read_keras_backbone("mobilenet", path, ""),
                    Contains("w.h5: holds 2 models that fit ('left', 'right')"));
  layers.pop_back();
  {
    LegacyFile file(path);
    file.add_group("cut", layers, 0);
    file.add(dense("dense", 1024, 5));
    file.close();
  }
  CHECK_THROWS_WITH(read_keras_backbone("mobilenet", path, ""), Contains("the model needs 54; missing: conv_pw_13_bn"));
}

TEST_CASE("layers or arrays in another order than the model's are refused by name") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "w.h5";
  const auto message = [&](const std::vector<NamedLayer>& layers) -> std::string {
    {
      LegacyFile file(path);
      for (const NamedLayer& layer : layers) file.add(layer);
      file.close();
    }
    try {
      read_keras_backbone("mobilenet", path, "");
    } catch (const Error& error) {
      return error.what();
    }
    return "read";
  };
  const auto layers = layers_of("mobilenet", false);
  REQUIRE(message(layers) == "read");
  auto swapped = layers;
  std::swap(swapped[2], swapped[4]);
  CHECK_THAT(message(swapped),
             Contains(joined("layer 3 is '", layers[4].name, "' where the model has '", layers[2].name,
                             "'; the layers of the file are not in the order of the model")));
  swapped = layers;
  REQUIRE(swapped[1].arrays[0].name == "gamma");
  std::swap(swapped[1].arrays[0], swapped[1].arrays[1]);
  CHECK_THAT(message(swapped), Contains(joined("layer '", layers[1].name,
                                               "' has its 'beta' where 'gamma' belongs; the weights of a layer must be "
                                               "in Keras' order")));
}

TEST_CASE("names that Keras made say nothing of a layer's place, others that look alike do not matter") {
  const TemporaryFolder folder;
  for (const char* name : {"conv2d", "conv2d_7", "conv2d_", "conv2d10", "conv2d_a", "mine"}) {
    CAPTURE(name);
    auto layers = layers_of("mobilenet", false);
    const auto path = folder.path() / "w.h5";
    const std::string original = std::exchange(layers[0].name, name);
    {
      LegacyFile file(path);
      for (const NamedLayer& layer : layers) file.add(layer);
      file.close();
    }
    layers[0].name = original;
    check_read("mobilenet", path, layers, {});
  }
}

TEST_CASE("Keras 3 weights with a layer too few of a class are refused by the layer that lacks them") {
  const TemporaryFolder folder;
  auto layers = layers_of("mobilenet", false);
  const auto path = folder.path() / "w.weights.h5";
  layers.pop_back();
  Hdf5File file = Hdf5File::create(path);
  add_keras3(file, "layers", layers);
  file.close();
  CHECK_THROWS_WITH(read_keras_backbone("mobilenet", path, ""),
                    Contains("w.weights.h5: ") && Contains("conv_pw_13_bn"));
}

TEST_CASE("class names become Keras' names of layers") {
  for (const auto& [class_name, name] : {std::pair("Conv2D", "conv2d"),
                                         {"GlobalAveragePooling2D", "global_average_pooling2d"},
                                         {"BatchNormalization", "batch_normalization"},
                                         {"PReLU", "p_re_lu"},
                                         {"LSTMCell", "lstm_cell"},
                                         {"Add", "add"}})
    CHECK(snake_case(class_name) == name);
}
