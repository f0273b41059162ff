#include "io/keras/keras_weights.h"

#include <map>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/finite.h"
#include "base/text.h"

namespace svnet::io {
namespace {

constexpr char kModelGroup[] = "model_weights";
constexpr char kOwnWeights[] = "top_level_model_weights";
constexpr char kSeedGenerator[] = "seed_generator";

/// Keras 3 and, for `layers`, TensorFlow 2.13.
constexpr const char* kLayerGroups[] = {"layers", "_layer_checkpoint_dependencies"};

std::string path_to(const std::string& group, const std::string& name) {
  return group.empty() ? name : group + "/" + name;
}

/// A list of strings that Keras may have split over NAME0, NAME1, … because attributes have a limited size.
bool has_list(const Hdf5File& file, const std::string& group, const std::string& name) {
  return file.has_attribute(group, name) || file.has_attribute(group, name + "0");
}
std::vector<std::string> list(const Hdf5File& file, const std::string& group, const std::string& name) {
  if (file.has_attribute(group, name) || !file.has_attribute(group, name + "0"))
    return file.text_list_attribute(group, name);
  std::vector<std::string> whole;
  for (int piece = 0; file.has_attribute(group, name + std::to_string(piece)); ++piece) {
    const std::vector<std::string> part = file.text_list_attribute(group, name + std::to_string(piece));
    whole.insert(whole.end(), part.begin(), part.end());
  }
  return whole;
}

/// The group that holds a legacy file's layers.
std::string legacy_root(const Hdf5File& file) {
  return !has_list(file, "", "layer_names") && file.is_group(kModelGroup) ? kModelGroup : "";
}

/// The arrays that `weight_names` of a legacy file's group lists.
std::vector<KerasArray> legacy_arrays(const Hdf5File& file, const std::string& root, const std::string& layer) {
  const std::string group = path_to(root, layer);
  check(file.is_group(group), file.name(), ": layer '", printable(layer),
        "' is named in layer_names but has no group '", printable(group), "'");
  std::vector<KerasArray> arrays;
  for (const std::string& name : list(file, group, "weight_names")) {
    const std::string dataset = path_to(group, name);
    check(file.has(dataset), file.name(), ": dataset '", printable(dataset), "' is named in weight_names but missing");
    arrays.push_back({name, file.shape(dataset), dataset});
  }
  return arrays;
}

/// "conv1" of the array "conv1/kernel:0"; empty if the name has no layer.
std::string layer_of(const KerasArray& array) {
  const std::size_t end = array.name.rfind('/');
  return end == std::string::npos ? std::string() : array.name.substr(0, end);
}

/// One layer, or, if the names of its arrays have several layers, the layers of a model inside the model.
std::vector<KerasLayer> legacy_layers_of(const Hdf5File& file, const std::string& root, const std::string& name) {
  std::vector<KerasArray> arrays = legacy_arrays(file, root, name);
  std::vector<std::pair<std::string, std::vector<KerasArray>>> parts;
  std::map<std::string, std::size_t> place;
  for (KerasArray& array : arrays) {
    const std::string part = layer_of(array);
    if (const auto [at, is_new] = place.emplace(part, parts.size()); is_new) parts.push_back({part, {}});
    parts[place.at(part)].second.push_back(array);
  }
  if (parts.size() < 2)
    return {{.path = name, .model = {}, .class_name = {}, .layer_name = name, .arrays = std::move(arrays)}};
  std::vector<KerasLayer> layers;
  for (auto& [part, own_arrays] : parts)
    layers.push_back({.path = part.starts_with(name + "/") ? part : path_to(name, part),
                      .model = name,
                      .class_name = {},
                      .layer_name = part.substr(part.rfind('/') + 1),
                      .arrays = std::move(own_arrays)});
  return layers;
}

/// The group of a Keras 3 file's layers; empty if there is none.
std::string keras3_root(const Hdf5File& file) {
  for (const char* group : kLayerGroups)
    if (file.is_group(group)) return group;
  return {};
}

std::vector<KerasArray> arrays_of(const Hdf5File& file, const std::string& vars) {
  std::vector<KerasArray> arrays;
  for (const std::string& name : file.members(vars)) {
    check(name == std::to_string(arrays.size()), file.name(), ": group '", printable(vars), "' holds '",
          printable(name), "' where '", arrays.size(), "' is expected");
    arrays.push_back({name, file.shape(path_to(vars, name)), path_to(vars, name)});
  }
  return arrays;
}

/// "functional" of "functional/layers/conv2d"; empty for a layer of the model itself.
std::string model_of(const std::string& path) {
  const std::size_t end = path.rfind('/');
  if (end == std::string::npos) return {};
  std::string model = path.substr(0, end);
  for (const std::string group : kLayerGroups)
    if (model.ends_with("/" + group)) model.resize(model.size() - group.size() - 1);
  return model;
}

KerasLayer keras3_layer(const Hdf5File& file, const std::string& group, const std::string& path) {
  const std::string vars = path_to(group, "vars");
  KerasLayer layer;
  layer.path = path;
  layer.class_name = path.substr(path.rfind('/') + 1);
  layer.model = model_of(path);
  const std::size_t end = layer.class_name.find_last_not_of("0123456789");
  const std::size_t digits = layer.class_name.size() - (end + 1);
  if (end != std::string::npos && end > 0 && layer.class_name[end] == '_' && digits > 0 && digits < 10) {
    layer.counter = std::stoll(layer.class_name.substr(end + 1));
    layer.class_name.resize(end);
  }
  if (file.has_attribute(vars, "name")) layer.layer_name = file.text_attribute(vars, "name");
  layer.arrays = arrays_of(file, vars);
  return layer;
}

/// Everything below `group` that has `vars`, the group itself first. A damaged file may link groups in a circle.
void collect_keras3(const Hdf5File& file, const std::string& group, const std::string& path, int depth,
                    std::vector<KerasLayer>& layers) {
  check(depth < 16 && layers.size() < 100'000, file.name(), ": group '", printable(group),
        "' is nested too deeply; the file is damaged");
  if (!path.empty() && file.is_group(path_to(group, "vars"))) layers.push_back(keras3_layer(file, group, path));
  for (const std::string& name : file.members(group)) {
    if (name == "vars" || name == kSeedGenerator || !file.is_group(path_to(group, name))) continue;
    collect_keras3(file, path_to(group, name), path_to(path, name), depth + 1, layers);
  }
}

KerasLayout layout_of(const Hdf5File& file) {
  if (has_list(file, legacy_root(file), "layer_names")) return KerasLayout::legacy;
  check(!keras3_root(file).empty(), file.name(),
        ": holds no Keras weights (neither an attribute layer_names nor a group layers)");
  return KerasLayout::keras3;
}

std::vector<KerasLayer> legacy_layers(const Hdf5File& file) {
  const std::string root = legacy_root(file);
  std::vector<KerasLayer> layers;
  std::set<std::string> seen;
  for (const std::string& layer : list(file, root, "layer_names")) {
    check(seen.insert(layer).second, file.name(), ": layer_names has '", printable(layer), "' twice");
    for (KerasLayer& part : legacy_layers_of(file, root, layer)) layers.push_back(std::move(part));
  }
  if (seen.count(kOwnWeights) == 0 && file.is_group(path_to(root, kOwnWeights)) &&
      has_list(file, path_to(root, kOwnWeights), "weight_names")) {
    KerasLayer own{.path = kOwnWeights, .model = {}, .class_name = {}, .layer_name = {}, .arrays = {}};
    own.arrays = legacy_arrays(file, root, kOwnWeights);
    if (!own.arrays.empty()) layers.push_back(std::move(own));
  }
  return layers;
}

std::vector<KerasLayer> keras3_layers(const Hdf5File& file) {
  std::vector<KerasLayer> layers;
  collect_keras3(file, keras3_root(file), "", 0, layers);
  if (file.is_group("vars")) {
    KerasLayer own;
    own.arrays = arrays_of(file, "vars");
    if (!own.arrays.empty()) layers.push_back(std::move(own));
  }
  return layers;
}

}  // namespace

KerasWeightsFile::KerasWeightsFile(const std::filesystem::path& path)
    : file_(Hdf5File::open(path)),
      layout_(layout_of(file_)),
      layers_(layout_ == KerasLayout::legacy ? legacy_layers(file_) : keras3_layers(file_)) {}

std::vector<float> KerasWeightsFile::values(const KerasArray& array) const {
  std::vector<float> values = file_.read<float>(array.dataset).values;
  if (const auto bad = first_not_finite(values))
    fail(name(), ": dataset '", printable(array.dataset), "': value ", *bad,
         " is not finite; the weights are damaged or were never trained");
  return values;
}

}  // namespace svnet::io
