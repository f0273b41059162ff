#include "io/keras/keras_weights.h"

#include <catch2/catch.hpp>
#include <limits>
#include <map>
#include <utility>

#include "base/error.h"
#include "io/hdf5/hdf5_file.h"
#include "shared_folder.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
using Catch::Contains;

namespace {

using Texts = std::vector<std::string>;
using Shape = std::vector<Index>;

struct ReadArray : KerasArray {
  std::vector<float> values;
};
struct ReadLayer : KerasLayer {
  std::vector<ReadArray> arrays;
};

/// The whole file.
std::vector<ReadLayer> read_weights(const std::filesystem::path& path) {
  const KerasWeightsFile file(path);
  std::vector<ReadLayer> layers;
  for (const KerasLayer& layer : file.layers()) {
    layers.push_back({layer, {}});
    for (const KerasArray& array : layer.arrays) layers.back().arrays.push_back({array, file.values(array)});
  }
  return layers;
}

KerasLayout keras_layout(const std::filesystem::path& path) { return KerasWeightsFile(path).layout(); }

std::string fixture(const std::string& name) { return SVNET_FIXTURES "/io/" + name; }

/// Array `k` of a model made by make_io_fixtures.py.
bool is_counted(const ReadArray& array, int k) {
  for (std::size_t i = 0; i < array.values.size(); ++i)
    if (array.values[i] != static_cast<float>(k) + static_cast<float>(i) / 64) return false;
  return true;
}

template <class Layer>
Texts array_names(const Layer& layer) {
  Texts names;
  for (const ReadArray& array : layer.arrays) names.push_back(array.name);
  return names;
}

void write_legacy(const std::filesystem::path& path, const std::vector<float>& kernel, const Texts& weight_names) {
  Hdf5File file = Hdf5File::create(path);
  file.write<float>("dense/dense/kernel", {static_cast<Index>(kernel.size())}, kernel);
  file.write_text_list_attribute("", "layer_names", Texts{"dense"});
  file.write_text_list_attribute("dense", "weight_names", weight_names);
  file.close();
}

}  // namespace

TEST_CASE("legacy weights that Keras 3 wrote are read in the order of the model") {
  REQUIRE(keras_layout(fixture("keras_legacy.h5")) == KerasLayout::legacy);
  const auto layers = read_weights(fixture("keras_legacy.h5"));
  REQUIRE(layers.size() == 3);
  CHECK(layers[0].path == "stem");
  CHECK(array_names(layers[0]) == Texts{"sequential/stem/kernel", "sequential/stem/bias"});
  CHECK(layers[0].arrays[0].shape == Shape{3, 3, 1, 2});
  CHECK(layers[0].arrays[0].values.size() == 18);
  CHECK(layers[1].path == "batch_normalization");
  CHECK(array_names(layers[1]) == Texts{"sequential/batch_normalization/gamma", "sequential/batch_normalization/beta",
                                        "sequential/batch_normalization/moving_mean",
                                        "sequential/batch_normalization/moving_variance"});
  CHECK(layers[2].path == "dropout");
  CHECK(layers[2].arrays.empty());
  int k = 0;
  for (const auto& layer : layers)
    for (const auto& array : layer.arrays) CHECK(is_counted(array, k++));
}

TEST_CASE("legacy weights of a whole model are under model_weights") {
  const auto layers = read_weights(fixture("keras_model.h5"));
  REQUIRE(layers.size() == 1);
  CHECK(layers[0].path == "only");
  CHECK(array_names(layers[0]) == Texts{"sequential/only/kernel", "sequential/only/bias"});
  CHECK(layers[0].arrays[0].shape == Shape{2, 1});
  CHECK(is_counted(layers[0].arrays[0], 0));
  CHECK(is_counted(layers[0].arrays[1], 1));
}

TEST_CASE("split attributes, byte strings and other float types become the same weights") {
  const auto layers = read_weights(fixture("keras2_split.h5"));
  REQUIRE(layers.size() == 3);
  CHECK(layers[0].path == "input");
  CHECK(layers[0].arrays.empty());
  CHECK(layers[1].path == "fc1");
  CHECK(array_names(layers[1]) == Texts{"fc1/kernel:0", "fc1/bias:0"});
  CHECK(layers[1].arrays[0].shape == Shape{2, 3});
  CHECK(layers[1].arrays[0].values == std::vector<float>{0, 1, 2, 3, 4, 5});
  CHECK(layers[1].arrays[1].values == std::vector<float>{0.5f, -1, 65504});
  CHECK(array_names(layers[2]) == Texts{"prediction/kernel:0", "prediction/bias:0"});
  CHECK(layers[2].arrays[0].values == std::vector<float>{1, 2, 3});
  CHECK(layers[2].arrays[1].values == std::vector<float>{4});
}

TEST_CASE("weights of the model itself come last") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "own.h5";
  Hdf5File file = Hdf5File::create(path);
  file.write<float>("top_level_model_weights/scale", {1}, std::vector<float>{2});
  file.write_text_list_attribute("top_level_model_weights", "weight_names", Texts{"scale"});
  file.create_group("dropout");
  file.write_text_list_attribute("dropout", "weight_names", Texts{});
  file.write_text_list_attribute("", "layer_names", Texts{"dropout"});
  file.close();
  const auto layers = read_weights(path);
  REQUIRE(layers.size() == 2);
  CHECK(layers[1].path == "top_level_model_weights");
  CHECK(layers[1].arrays.at(0).values == std::vector<float>{2});
}

TEST_CASE("damaged legacy weights are refused by name") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "w.h5";
  const auto message = [&] {
    try {
      read_weights(path);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  write_legacy(path, {1, std::numeric_limits<float>::quiet_NaN()}, {"dense/kernel"});
  CHECK_THAT(message(), Contains("w.h5: dataset 'dense/dense/kernel': value 1 is not finite"));
  write_legacy(path, {1}, {"dense/kernel", "dense/bias"});
  CHECK_THAT(message(), Contains("w.h5: dataset 'dense/dense/bias' is named in weight_names but missing"));

  Hdf5File file = Hdf5File::create(path);
  file.write_text_list_attribute("", "layer_names", Texts{"a"});
  file.close();
  CHECK_THAT(message(), Contains("w.h5: layer 'a' is named in layer_names but has no group 'a'"));
  file = Hdf5File::create(path);
  file.create_group("a");
  file.write_text_list_attribute("", "layer_names", Texts{"a", "a"});
  file.write_text_list_attribute("a", "weight_names", Texts{});
  file.close();
  CHECK_THAT(message(), Contains("w.h5: layer_names has 'a' twice"));
  file = Hdf5File::create(path);
  file.create_group("a");
  file.write_text_list_attribute("", "layer_names", Texts{"a"});
  file.close();
  CHECK_THAT(message(), Contains("w.h5: attribute 'weight_names' of 'a': is missing"));
  CHECK_THROWS_WITH(read_weights(fixture("h5py.h5")), Contains("h5py.h5: holds no Keras weights"));
}

TEST_CASE("a float64 weight too large for float32 is not finite") {
  const TemporaryFolder folder;
  Hdf5File file = Hdf5File::create(folder.path() / "w.h5");
  file.write<double>("a/x", {1}, std::vector<double>{1e300});
  file.write_text_list_attribute("", "layer_names", Texts{"a"});
  file.write_text_list_attribute("a", "weight_names", Texts{"x"});
  file.close();
  CHECK_THROWS_WITH(read_weights(folder.path() / "w.h5"), Contains("dataset 'a/x': value 0 is not finite"));
}

TEST_CASE("Keras 3 weights keep class, counter and the layer's own name") {
  REQUIRE(keras_layout(fixture("keras3.weights.h5")) == KerasLayout::keras3);
  const auto layers = read_weights(fixture("keras3.weights.h5"));
  REQUIRE(layers.size() == 3);
  CHECK(layers[0].path == "batch_normalization");
  CHECK(array_names(layers[0]) == Texts{"0", "1", "2", "3"});
  CHECK(layers[1].path == "conv2d");
  CHECK(layers[1].class_name == "conv2d");
  CHECK(layers[1].counter == 0);
  CHECK(layers[1].layer_name == "stem");
  CHECK(layers[1].arrays[0].shape == Shape{3, 3, 1, 2});
  CHECK(is_counted(layers[1].arrays[0], 0));
  CHECK(is_counted(layers[1].arrays[1], 1));
  for (int i = 0; i < 4; ++i) CHECK(is_counted(layers[0].arrays[static_cast<std::size_t>(i)], 2 + i));
  CHECK(layers[2].path == "dropout");
  CHECK(layers[2].arrays.empty());
}

TEST_CASE("Keras 3 weights of models inside models are read") {
  const auto layers = read_weights(fixture("keras3_nested.weights.h5"));
  REQUIRE(layers.size() == 4);
  CHECK(layers[0].path == "dense");
  CHECK(layers[0].layer_name == "first");
  CHECK(layers[1].path == "dense_1");
  CHECK(layers[1].class_name == "dense");
  CHECK(layers[1].counter == 1);
  CHECK(layers[1].layer_name == "second");
  CHECK(layers[2].path == "sequential");
  CHECK(layers[2].arrays.empty());
  CHECK(layers[3].path == "sequential/layers/dense");
  CHECK(layers[3].class_name == "dense");
  CHECK(is_counted(layers[0].arrays[0], 0));
  CHECK(is_counted(layers[3].arrays[0], 2));
  CHECK(is_counted(layers[1].arrays[1], 5));
}

TEST_CASE("Keras 3 layers are in numeric order, random states are skipped, the model's own weights are last") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "w.weights.h5";
  Hdf5File file = Hdf5File::create(path);
  for (const char* layer : {"conv2d_10", "conv2d_2", "conv2d"})
    for (const char* variable : {"10", "9", "8", "7", "6", "5", "4", "3", "2", "1", "0"})
      file.write<float>(joined("layers/", layer, "/vars/", variable), {1}, std::vector<float>{std::stof(variable)});
  file.write<std::int64_t>("layers/dropout/seed_generator/vars/0", {2}, std::vector<std::int64_t>{1, 2});
  file.create_group("layers/dropout/vars");
  file.write<std::int64_t>("optimizer/vars/0", {}, std::vector<std::int64_t>{1});
  file.write<float>("vars/0", {1}, std::vector<float>{7});
  file.close();
  const auto layers = read_weights(path);
  REQUIRE(layers.size() == 5);
  CHECK(layers[0].path == "conv2d");
  CHECK(layers[1].path == "conv2d_2");
  CHECK(layers[2].path == "conv2d_10");
  CHECK(layers[2].counter == 10);
  for (std::size_t i = 0; i < 11; ++i) CHECK(layers[1].arrays[i].values[0] == static_cast<float>(i));
  CHECK(layers[3].path == "dropout");
  CHECK(layers[4].path.empty());
  CHECK(layers[4].arrays[0].values[0] == 7);
}

TEST_CASE("Keras 3 weights with a missing layer are refused") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "w.weights.h5";
  Hdf5File file = Hdf5File::create(path);
  file.write<float>("layers/dense/vars/1", {1}, std::vector<float>{1});
  file.close();
  CHECK_THROWS_WITH(read_weights(path),
                    Contains("w.weights.h5: group 'layers/dense/vars' holds '1' where '0' is expected"));
}

TEST_CASE("a number at the end of a Keras 3 group's name is its counter, if there is a class before it") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "w.weights.h5";
  Hdf5File file = Hdf5File::create(path);
  const std::vector<float> one{1};
  for (const char* layer : {"dense_12", "dense_", "dense12", "12", "_12", "dense_1234567890"})
    file.write<float>(joined("layers/", layer, "/vars/0"), {1}, one);
  file.write<float>("layers/loose", {1}, one);  // an array where layers are, which is none
  file.close();
  std::map<std::string, std::pair<std::string, std::int64_t>> classes;
  for (const auto& layer : read_weights(path)) classes[layer.path] = {layer.class_name, layer.counter};
  CHECK(classes ==
        std::map<std::string, std::pair<std::string, std::int64_t>>{{"dense_12", {"dense", 12}},
                                                                    {"dense_", {"dense_", 0}},
                                                                    {"dense12", {"dense12", 0}},
                                                                    {"12", {"12", 0}},
                                                                    {"_12", {"_12", 0}},
                                                                    {"dense_1234567890", {"dense_1234567890", 0}}});
}

TEST_CASE("groups of a Keras 3 file that are nested without end are refused") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "w.weights.h5";
  Hdf5File file = Hdf5File::create(path);
  std::string group = "layers";
  for (int depth = 0; depth < 20; ++depth) group += "/a";
  file.create_group(group);
  file.close();
  CHECK_THROWS_WITH(read_weights(path), Contains("w.weights.h5: group 'layers/a/a") &&
                                            Contains("is nested too deeply; the file is damaged"));
}

TEST_CASE("arrays of a legacy layer that name several layers are a model inside the model") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "w.h5";
  Hdf5File file = Hdf5File::create(path);
  const Texts names{"inner/conv/kernel:0", "other/bias:0", "inner/conv/bias:0"};
  for (const std::string& name : names) file.write<float>("inner/" + name, {1}, std::vector<float>{1});
  file.write_text_list_attribute("inner", "weight_names", names);
  file.create_group("top_level_model_weights");  // of a model without weights of its own; Keras may leave out the list
  file.write_text_list_attribute("", "layer_names", Texts{"inner"});
  file.close();
  const auto layers = read_weights(path);
  REQUIRE(layers.size() == 2);
  CHECK(layers[0].path == "inner/conv");
  CHECK(layers[0].model == "inner");
  CHECK(layers[0].layer_name == "conv");
  CHECK(array_names(layers[0]) == Texts{names[0], names[2]});
  CHECK(layers[1].path == "inner/other");
  CHECK(layers[1].layer_name == "other");
}

TEST_CASE("a real MobileNetV2 is read completely") {
  const std::filesystem::path path =
      shared_folder("weights/mobilenet_v2_weights_tf_dim_ordering_tf_kernels_1.0_224.h5");
  if (!std::filesystem::exists(path)) {
    WARN("skipped: " << path.string() << " is absent");
    return;
  }
  const auto layers = read_weights(path);
  REQUIRE(layers.size() == 156);
  CHECK(layers[1].path == "Conv1");
  CHECK(layers[1].arrays.at(0).shape == Shape{3, 3, 3, 32});
  CHECK(layers.back().path == "predictions");
  CHECK(layers.back().arrays.at(0).shape == Shape{1280, 1000});
  Index values = 0;
  for (const auto& layer : layers)
    for (const auto& array : layer.arrays) values += static_cast<Index>(array.values.size());
  CHECK(values == 3'538'984);
}
