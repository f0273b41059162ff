#include "info/describe.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/error.h"
#include "base/text.h"
#include "data/scores_summary.h"
#include "info/describe_model.h"
#include "io/hdf5/hdf5_file.h"
#include "io/keras/keras_weights.h"
#include "io/models/model_file.h"
#include "io/tensors/safetensors.h"
#include "io/views/features_file.h"
#include "io/views/scores_file.h"
#include "nn/tensor.h"

namespace svnet {
using io::Hdf5File;

namespace {

std::string describe_features(const std::filesystem::path& file) {
  const Features f = io::read_features(file);
  if (f.paths.empty())
    return joined("features of ", f.count, " views, ", f.dimension,
                  " numbers each, with labels instead of paths: of another program");
  return joined("features of ", f.count, " views, ", f.dimension, " numbers each\n  backbone       ",
                printable(f.backbone), ", layer ", printable(f.output), "\n  preprocessing  ",
                printable(f.preprocessing), "\n  weights        ", printable(f.weights_sha256), "\n  dataset        ",
                printable(f.dataset_fingerprint), "\n  fingerprint    ", printable(f.input_fingerprint),
                "\n  first view     ", printable(f.paths.front()), "\n  last view      ", printable(f.paths.back()));
}

std::string describe_scores(const std::filesystem::path& file) {
  const Scores s = io::read_scores(file);
  const ScoresSummary known = summary(s);
  return joined("semantic scores of ", s.paths.size(), " views\n  problems        ", s.problems, ", seed ", s.seed,
                "\n  sampler         ", printable(s.sampler), "\n  clustering      ", printable(s.clustering),
                ", metric ", printable(s.metric), "\n  views without   ", known.left_out, "\n  problems a view ",
                known.most == 0 ? std::string("none") : joined(known.fewest, " to ", known.most),
                "\n  standard error  at most ", known.largest_error, "\n  rank stability  ",
                std::isnan(known.mean_stability) ? std::string("none") : joined(known.mean_stability, " on average"),
                "\n  fingerprint     ", printable(s.input_fingerprint));
}

std::string describe_snapshot(const std::filesystem::path& file) {
  const io::ScoresSnapshot s = io::read_scores_snapshot(file);
  return joined("snapshot of semantic scores of ", s.views, " views\n  problems so far ", s.problems);
}

void add_layer(std::ostringstream& text, const std::string& name, const std::vector<io::KerasArray>& arrays,
               Index& count) {
  if (arrays.empty()) return;
  text << "\n  " << printable(name) << ":";
  for (const auto& array : arrays) {
    text << " " << to_string(array.shape);
    count += element_count(array.shape);
  }
}

std::string describe_weights(const std::filesystem::path& file) {
  const io::KerasWeightsFile weights(file);
  std::ostringstream layers;
  Index count = 0;
  for (const auto& layer : weights.layers()) add_layer(layers, layer.path, layer.arrays, count);
  const bool legacy = weights.layout() == io::KerasLayout::legacy;
  return joined(legacy ? "Keras weights" : "Keras 3 weights", ", ", count,
                " numbers; layers and shapes in the order of the file:", layers.str());
}

/// Whether the description that svnet puts into a safetensors file says that it is a model.
bool is_model(const io::SafetensorsFile& file) {
  for (const auto& [key, value] : file.metadata())
    if (key == "svnet") {
      const auto description = nlohmann::json::parse(value, nullptr, false);
      return description.is_object() && description.value("kind", nlohmann::json()) == "model";
    }
  return false;
}

std::string describe_safetensors(const std::filesystem::path& file) {
  const io::SafetensorsFile f(file);
  std::ostringstream text;
  text << "safetensors, " << f.tensors().size() << " tensors";
  for (const auto& [key, value] : f.metadata())
    text << "\n  metadata '" << printable(key)
         << "': " << printable(value.size() > 400 ? value.substr(0, 400) + " …" : value);
  for (const auto& tensor : f.tensors())
    text << "\n  " << printable(tensor.name) << ": " << tensor.dtype << " " << to_string(tensor.shape);
  return text.str();
}

bool is_hdf5(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  check(stream.good(), file.string(), ": cannot be read: no such file, or no permission");
  char start[8]{};
  stream.read(start, sizeof start);
  return std::equal(start, start + 8, "\x89HDF\r\n\x1a\n");
}

}  // namespace

std::string description_of(const std::filesystem::path& file, bool with_tensors) {
  check(!std::filesystem::exists(file) || std::filesystem::is_regular_file(file), file.string(),
        ": is a folder or device, expected a file");
  if (!is_hdf5(file)) {
    if (!is_model(io::SafetensorsFile(file))) return describe_safetensors(file);
    const std::string model = description_of(io::read_model(file));
    return with_tensors ? model + "\n" + describe_safetensors(file) : model;
  }
  const Hdf5File hdf5 = Hdf5File::open(file);
  if (hdf5.has("features")) return describe_features(file);
  if (hdf5.has("individual")) return describe_scores(file);
  if (hdf5.has("sums")) return describe_snapshot(file);
  return describe_weights(file);
}

}  // namespace svnet
