#include "train/feature_extraction.h"

#include <catch2/catch.hpp>
#include <limits>

#include "base/parallel.h"
#include "io/files/snapshot_path.h"
#include "io/hdf5/hdf5_file.h"
#include "io/models/backbone_file.h"
#include "io/views/dataset_folder.h"
#include "io/views/features_file.h"
#include "nn/graph/keras_order.h"
#include "small_dataset.h"

using namespace svnet;
using namespace svnet::io;
using namespace svnet::models;
using namespace svnet::train;

namespace {

Features extracted(const Backbone& backbone, const ViewDataset& dataset) {
  SingleProcess single_process;
  return extract_features(backbone, dataset, {}, {}, single_process);
}

/// The graph's parameters as a legacy Keras file; those of `changed` are `units` NaN.
void write_legacy(const std::filesystem::path& path, const Graph& graph, const Parameters& parameters,
                  const std::string& changed, Index units) {
  Hdf5File file = Hdf5File::create(path);
  std::vector<std::string> layers;
  for (NodeId id : keras_order(graph, graph.output())) {
    const GraphNode& node = graph.node(id);
    if (node.parameters.empty()) continue;
    std::vector<std::string> names;
    for (const auto& spec : node.parameters) {
      const Tensor& value = parameters.at(node.parameter_name(spec));
      Shape shape = spec.shape;
      std::vector<float> numbers(value.data<float>(), value.data<float>() + value.size());
      if (node.name == changed) {
        shape.back() = units;
        numbers.assign(static_cast<std::size_t>(element_count(shape)), std::numeric_limits<float>::quiet_NaN());
      }
      file.write<float>(joined(node.name, "/", spec.name), shape, numbers);
      names.push_back(spec.name);
    }
    file.write_text_list_attribute(node.name, "weight_names", names);
    layers.push_back(node.name);
  }
  file.write_text_list_attribute("", "layer_names", layers);
  file.close();
}

}  // namespace

TEST_CASE("a damaged image of a later batch is named, after the batches before it") {
  const TemporaryFolder folder;
  write_small_dataset(folder.path());
  const ViewDataset dataset = read_view_dataset(folder.path());
  REQUIRE(dataset.views.size() == 32);
  const std::string damaged = dataset.views[20].path;
  folder.write(damaged, "no image");
  const Backbone backbone = random_backbone("tiny_xception", "", 1);
  const int threads_before = Parallel::shared().threads();
  for (const int threads : {1, 2, 3, 8, 16}) {
    Parallel::shared().resize(threads);
    CHECK_THROWS_WITH(extracted(backbone, dataset), Catch::Contains(damaged));
  }
  Parallel::shared().resize(threads_before);
}

TEST_CASE("1, 2 and 8 threads, which take images in other batches, give the same bits", "[slow]") {
  const TemporaryFolder folder;
  write_small_dataset(folder.path());
  const ViewDataset dataset = read_view_dataset(folder.path());
  const int threads_before = Parallel::shared().threads();
  for (const char* name : {"tiny_xception", "mobilenet_v2"}) {
    const Backbone backbone = random_backbone(name, "", 1);
    Parallel::shared().resize(1);
    const Features one = extracted(backbone, dataset);
    for (const int threads : {2, 8}) {
      Parallel::shared().resize(threads);
      CHECK(extracted(backbone, dataset).values == one.values);
    }
  }
  Parallel::shared().resize(threads_before);
}

TEST_CASE("features do not depend on the other images of the batch") {
  const TemporaryFolder folder;
  write_small_dataset(folder.path());
  ViewDataset dataset = read_view_dataset(folder.path());
  const Backbone backbone = random_backbone("tiny_xception", "", 1);
  const Features together = extracted(backbone, dataset);
  dataset.views = {dataset.views[17]};
  const Features alone = extracted(backbone, dataset);
  REQUIRE(alone.count == 1);
  for (Index i = 0; i < alone.dimension; ++i)
    CHECK(alone.values[static_cast<std::size_t>(i)] ==
          together.values[static_cast<std::size_t>(17 * together.dimension + i)]);
}

TEST_CASE("if the output does not need the top, its shapes are checked, but its weights are not read") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "w.h5";
  const BackboneKind& kind = backbone_kind("mobilenet");
  const Graph graph = kind.graph(kind.preprocessing.height, true);
  std::string top;
  for (const auto& node : graph.nodes())
    if (!node.parameters.empty()) top = node.name;
  const Parameters parameters = initial_parameters(graph, 3);
  write_legacy(path, graph, parameters, top, 1000);
  KerasLoadReport report;
  const Backbone backbone = read_backbone("mobilenet", path, "", &report);
  CHECK(report.unused == std::vector<std::string>{top});
  CHECK_FALSE(backbone.graph().contains(top));
  CHECK_FALSE(backbone.parameters().contains(top + "/kernel"));
  CHECK_THROWS_WITH(read_backbone("mobilenet", path, top),
                    Catch::Contains("w.h5: dataset '" + top + "/kernel': value 0 is not finite"));
  write_legacy(path, graph, parameters, top, 999);
  CHECK_THROWS_WITH(read_backbone("mobilenet", path, top), Catch::Contains("the model expects '" + top + "'"));
  static_cast<void>(read_backbone("mobilenet", path, "", &report));
  CHECK(report.unused == std::vector<std::string>{top});
}

TEST_CASE("features that were interrupted go on from their snapshot, to the same bits") {
  const TemporaryFolder folder;
  write_small_dataset(folder.path() / "data");
  const ViewDataset dataset = read_view_dataset(folder.path() / "data");
  const BackboneWithOrigin source{random_backbone("tiny_xception", "", 1), "random, seed 1"};
  const FeaturesOrigin origin = features_origin(source, "data");
  const auto file = folder.path() / "features.h5", snapshot = snapshot_path(file);
  SingleProcess single_process;
  struct Stop {};
  std::vector<std::string> lines;
  const Messages stopping{.line = {}, .progress = [](std::string_view, Index, Index, double) { throw Stop{}; }},
      listening{.line = [&](std::string_view line) { lines.emplace_back(line); }, .progress = {}};
  const auto extract = [&](const FeaturesOrigin& from, const Messages& messages) {
    return extract_features(source.backbone, dataset, from, messages, single_process, snapshot);
  };
  CHECK_THROWS_AS(extract(origin, stopping), Stop);
  const Index kept = read_features(snapshot).count;  // the batches that were begun
  CHECK(kept > 0);
  CHECK(kept <= static_cast<Index>(dataset.views.size()));

  // Those of other images are not used.
  CHECK(extract(features_origin(source, "others"), listening).values == extracted(source.backbone, dataset).values);
  CHECK(lines.empty());

  const Features features = extract(origin, listening);
  CHECK(features.values == extracted(source.backbone, dataset).values);
  CHECK(lines == std::vector<std::string>{joined("features of tiny_xception: go on after ", kept, " views")});
  write_made_features(file, features);
  CHECK_FALSE(std::filesystem::exists(snapshot));

  folder.write("features.h5.snapshot", "damaged");
  lines.clear();
  CHECK(extract(origin, listening).values == features.values);
  REQUIRE(lines.size() == 1);
  CHECK_THAT(lines[0], Catch::StartsWith("made again: "));
}
