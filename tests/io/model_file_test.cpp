#include "io/models/model_file.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "frame/frame_inputs.h"
#include "frame/next_inputs.h"
#include "frame/top_frame.h"
#include "io/models/checkpoint.h"
#include "io/models/graph_json.h"
#include "io/tensors/safetensors.h"
#include "io/tensors/tensor_file.h"
#include "models/backbone.h"
#include "models/pose_head.h"
#include "models/turned_backbone.h"
#include "nn/graph/run.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
using namespace svnet::models;

namespace {

Model small_model() {
  const Backbone backbone = random_backbone("tiny_xception", "", 2);
  Model model{.backbone = "tiny_xception",
              .backbone_output = "avg_pool",
              .preprocessing = backbone.preprocessing(),
              .backbone_graph = backbone.graph(),
              .backbone_parameters = backbone.parameters(),
              .angles = AngleEncoding::sphere,
              .head = sv_net({.features = backbone.dimension(), .width = 8, .angles = AngleEncoding::sphere}),
              .head_parameters = {},
              .input_fingerprint = "abc"};
  model.head_parameters = initial_parameters(model.head, 4);
  return model;
}

Model axis_model(frame::DepthChoice depth) {
  Model model;
  model.frame = frame::FrameChoice::axis;
  model.depth = depth;
  model.head = linear_head(frame::pose_input_count(frame::input_options(depth)));
  model.head_parameters = initial_parameters(model.head, 4);
  model.input_fingerprint = "abc";
  return model;
}

Model turned_model(frame::FrameChoice choice, frame::DepthChoice depth) {
  const Backbone backbone = random_backbone("tiny_xception", "", 2);
  Model model = axis_model(depth);
  model.frame = choice;
  model.backbone = "tiny_xception";
  model.backbone_output = "projection";
  model.preprocessing = backbone.preprocessing();
  model.backbone_graph = projected_graph(pooled_graph(backbone.graph()), 2);
  model.backbone_parameters = initial_parameters(model.backbone_graph, 3);
  model.head = linear_head(frame::input_count(frame_spec(model)));
  model.head_parameters = initial_parameters(model.head, 4);
  return model;
}

/// A head of dense layers that takes inputs of the given shapes and gives `outputs` scores.
Graph head_of(const std::vector<Shape>& inputs, Index outputs = 1) {
  Graph head;
  std::vector<NodeId> ids;
  for (const Shape& shape : inputs) ids.push_back(head.input(joined("input", ids.size()), shape));
  const NodeId all = ids.size() == 1 ? ids[0] : head.add("all", ConcatLayer{}, ids);
  head.add("score", DenseLayer{.units = outputs}, {all});
  return head;
}

/// Writes the model of `from` to `to` with a description that `change` has changed.
void write_changed(const std::filesystem::path& from, const std::filesystem::path& to,
                   const std::function<void(nlohmann::json&)>& change) {
  const SafetensorsFile good(from);
  auto metadata = good.metadata();
  nlohmann::json description = nlohmann::json::parse(metadata.at("svnet"));
  change(description);
  metadata.at("svnet") = description.dump();
  write_safetensors(to, good.tensors(), metadata);
}

bool equal(const Tensor& a, const Tensor& b) {
  return a.shape() == b.shape() &&
         std::memcmp(a.data<float>(), b.data<float>(), static_cast<std::size_t>(a.size()) * sizeof(float)) == 0;
}

}  // namespace

TEST_CASE("a model is read with the same bits") {
  const TemporaryFolder temporary;
  const auto path = temporary.path() / "model.safetensors";
  const Model model = small_model();
  write_model(path, model);
  const Model back = read_model(path);
  CHECK(back.backbone == "tiny_xception");
  CHECK(back.input_fingerprint == "abc");
  CHECK(back.preprocessing.mode == PixelMode::tf);
  CHECK(back.angles == AngleEncoding::sphere);
  const Tensor image = Tensor::full({1, 96, 96, 3}, 0.5), angles = Tensor::full({1, 3}, 0.25);
  const auto score = [&](const Model& m) {
    const Tensor features =
        run_inference(m.backbone_graph, m.backbone_parameters, {image}, {m.backbone_graph.find(m.backbone_output)})[0];
    return run_inference(m.head, m.head_parameters, {features, angles}, {m.head.output()})[0];
  };
  CHECK(equal(score(model), score(back)));
}

TEST_CASE("a model file says the number of orientations of the top image if it is not 1") {
  const TemporaryFolder temporary;
  const auto path = temporary.path() / "model.safetensors";
  const auto written = [&](int orientations, Index height) {
    Model model = small_model();
    model.symmetries = orientations;
    model.preprocessing.height = height;
    write_model(path, model);
    return read_model(path).symmetries;
  };
  CHECK(written(8, 96) == 8);
  CHECK(TensorFile::read(path, "model").get<nlohmann::json>("head").contains("orientations"));
  CHECK(written(1, 96) == 1);
  CHECK_FALSE(TensorFile::read(path, "model").get<nlohmann::json>("head").contains("orientations"));
  CHECK_THROWS_WITH(written(4, 96), path.string() + ": there are 4 orientations, expected 1 or 8");
  CHECK_THROWS_WITH(written(8, 64), path.string() + ": images of 64x96 cannot be turned; only square ones can");
  CHECK_THROWS_WITH(written(1, 64),
                    path.string() + ": the backbone does not take images of 64x96, as preprocessing makes them");
}

TEST_CASE("a model in the frame axis is read with the same bits") {
  const TemporaryFolder temporary;
  const auto path = temporary.path() / "model.safetensors";
  for (const frame::DepthChoice depth : {frame::DepthChoice::none, frame::DepthChoice::heights}) {
    const Model model = axis_model(depth);
    write_model(path, model);
    const Model back = read_model(path);
    CHECK(back.frame == frame::FrameChoice::axis);
    CHECK(back.depth == depth);
    CHECK(back.backbone.empty());
    CHECK(back.backbone_graph.nodes().empty());
    CHECK(back.input_fingerprint == "abc");
    for (const auto& [name, value] : model.head_parameters.items()) CHECK(equal(back.head_parameters.at(name), value));
    const auto description = TensorFile::read(path, "model").description();
    CHECK(description.at("frame") == nlohmann::json{{"kind", "axis"}, {"depth", name_of(depth)}});
    for (const char* member : {"backbone", "preprocessing", "angles"}) CHECK_FALSE(description.contains(member));
  }
}

TEST_CASE("a damaged model in the frame axis is refused") {
  const TemporaryFolder temporary;
  const auto path = temporary.path() / "model.safetensors", bad = temporary.path() / "bad.safetensors";
  Model model = axis_model(frame::DepthChoice::none);
  model.depth = frame::DepthChoice::heights;  // which has more inputs
  write_model(path, model);
  CHECK_THROWS_WITH(read_model(path), Catch::StartsWith(path.string() + ": the head does not take the ") &&
                                          Catch::EndsWith(" inputs of a camera pose, or gives more than one score"));
  write_model(path, axis_model(frame::DepthChoice::none));
  write_changed(path, bad, [](nlohmann::json& description) { description["frame"]["kind"] = "axes"; });
  CHECK_THROWS_WITH(read_model(bad), bad.string() + ": frame: kind is 'axes', which this version does not know");
  write_changed(path, bad, [](nlohmann::json& description) { description["frame"].erase("depth"); });
  CHECK_THROWS_WITH(read_model(bad), Catch::StartsWith(bad.string()) && Catch::Contains("depth"));
  write_changed(path, bad, [](nlohmann::json& description) { description["frame"] = "axis"; });
  CHECK_THROWS_WITH(read_model(bad), Catch::StartsWith(bad.string()));
  write_changed(path, bad, [](nlohmann::json& description) { description["frame"]["kind"] = "camera"; });
  CHECK_THROWS_WITH(read_model(bad), Catch::StartsWith(bad.string()));
  write_changed(path, bad, [](nlohmann::json& description) { description.erase("frame"); });
  CHECK_THROWS_WITH(read_model(bad), Catch::StartsWith(bad.string()) && Catch::Contains("backbone"));
}

TEST_CASE("a model whose image has no usable size, or another order of channels, is refused") {
  const TemporaryFolder temporary;
  const auto path = temporary.path() / "model.safetensors", bad = temporary.path() / "bad.safetensors";
  write_model(path, small_model());
  const auto read_with = [&](const char* key, const nlohmann::json& value) {
    write_changed(path, bad, [&](nlohmann::json& d) { d["preprocessing"][key] = value; });
    static_cast<void>(read_model(bad));
  };
  CHECK_THROWS_WITH(read_with("height", 0), bad.string() + ": input size 0x96 is out of range");
  CHECK_THROWS_WITH(read_with("width", -1), bad.string() + ": input size 96x-1 is out of range");
  CHECK_THROWS_WITH(read_with("height", 8193), bad.string() + ": input size 8193x96 is out of range");
  CHECK_THROWS_WITH(read_with("width", 8193), bad.string() + ": input size 96x8193 is out of range");
  CHECK_THROWS_WITH(read_with("channels", "BGR"), bad.string() + ": channels are \"BGR\", expected RGB");
  CHECK_THROWS_WITH(read_with("pixels", "caffeine"),
                    Catch::StartsWith(bad.string() + ": ") && Catch::Contains("caffe"));
}

TEST_CASE("a model whose parts do not fit each other is refused") {
  const TemporaryFolder temporary;
  const auto path = temporary.path() / "model.safetensors";
  const auto read_with_head = [&](Model model, const Graph& head) {
    model.head = head;
    model.head_parameters = initial_parameters(model.head, 4);
    write_model(path, model);
    static_cast<void>(read_model(path));
  };
  const Model camera = small_model();
  const Index features = element_count(camera.backbone_graph.node(camera.backbone_graph.find("avg_pool")).shape);
  const std::string not_camera = path.string() + joined(": the head does not take the backbone's ", features,
                                                        " features and the angles, or gives more than one score");
  CHECK_NOTHROW(read_with_head(camera, head_of({{features}, {3}})));
  CHECK_THROWS_WITH(read_with_head(camera, head_of({{features}})), not_camera);
  CHECK_THROWS_WITH(read_with_head(camera, head_of({{features + 1}, {3}})), not_camera);
  CHECK_THROWS_WITH(read_with_head(camera, head_of({{features}, {4}})), not_camera);
  CHECK_THROWS_WITH(read_with_head(camera, head_of({{features}, {3}}, 2)), not_camera);
  Graph blind;
  const NodeId image_features = blind.input("features", {features});
  blind.input("angles", {3});
  blind.add("score", DenseLayer{.units = 1}, {image_features});
  CHECK_THROWS_WITH(read_with_head(camera, blind),
                    path.string() + ": the score of the head does not depend on its input 'angles'");

  const Model axis = axis_model(frame::DepthChoice::none);
  const Index inputs = frame::input_count(frame_spec(axis));
  const std::string not_axis = path.string() + joined(": the head does not take the ", inputs,
                                                      " inputs of a camera pose, or gives more than one score");
  CHECK_NOTHROW(read_with_head(axis, head_of({{inputs}})));
  CHECK_THROWS_WITH(read_with_head(axis, head_of({{inputs}, {1}})), not_axis);
  CHECK_THROWS_WITH(read_with_head(axis, head_of({{inputs}}, 2)), not_axis);

  Model two_images = camera;
  Graph& backbone = two_images.backbone_graph;
  const NodeId second = backbone.input("second", {features});
  backbone.add("sum", AddLayer{}, {backbone.find("avg_pool"), second});
  two_images.backbone_output = "sum";
  write_model(path, two_images);
  CHECK_THROWS_WITH(read_model(path),
                    path.string() + ": the backbone does not take images of 96x96, as preprocessing makes them");
}

TEST_CASE("a model keeps the head of the next view, and one that does not fit is refused") {
  const TemporaryFolder temporary;
  const auto path = temporary.path() / "model.safetensors";
  Model model = axis_model(frame::DepthChoice::none);
  write_model(path, model);
  CHECK(read_model(path).next_head.nodes().empty());
  const auto write_with = [&](const Graph& head) {
    model.next_head = head;
    model.next_parameters = initial_parameters(head, 5);
    write_model(path, model);
  };
  const Index inputs = frame::next_input_count(frame_spec(model));
  write_with(linear_head(inputs));
  const Model back = read_model(path);
  for (const auto& [name, value] : model.next_parameters.items()) CHECK(equal(back.next_parameters.at(name), value));
  const std::string refusal =
      path.string() + joined(": the head of the next view does not take the ", inputs,
                             " inputs of a camera pose and a taken view, or gives more than one score");
  for (const Graph& head : {head_of({{inputs + 1}}), head_of({{inputs}, {1}}), head_of({{inputs}}, 2)}) {
    write_with(head);
    CHECK_THROWS_WITH(read_model(path), refusal);
  }
}

TEST_CASE("a model says what it was trained on") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "model.safetensors", bad = folder.path() / "bad.safetensors";
  Model model = axis_model(frame::DepthChoice::none);
  write_model(path, model);
  CHECK(read_model(path).trained_on.categories.empty());
  model.trained_on = {{"mug", "pan"}, 5, 20};
  write_model(path, model);
  const TrainedOn on = read_model(path).trained_on;
  CHECK(on.categories == std::vector<std::string>{"mug", "pan"});
  CHECK(on.objects == 5);
  CHECK(on.top_views == 20);
  write_changed(path, bad, [](auto& d) { d["trained_on"]["objects"] = "five"; });
  CHECK_THROWS_WITH(read_model(bad), Catch::StartsWith(bad.string() + ": "));
}

TEST_CASE("a model says what it reached on held-out categories") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "model.safetensors", bad = folder.path() / "bad.safetensors";
  Model model = axis_model(frame::DepthChoice::none);
  write_model(path, model);
  CHECK(read_model(path).held_out.values.empty());
  model.held_out = {
      .categories = {"mug", "pan"},
      .problems = 100,
      .values = {{"vgg19_ward", "svnet", "fm", 0.5, 0.01}, {"vgg19_ward", "top", "fm", 0.4, std::nan("")}}};
  write_model(path, model);
  const HeldOutResults results = read_model(path).held_out;
  CHECK(results.categories == std::vector<std::string>{"mug", "pan"});
  CHECK(results.problems == 100);
  REQUIRE(results.values.size() == 2);
  CHECK(results.values[0].selector == "svnet");
  CHECK(results.values[0].mean == 0.5);
  CHECK(results.values[0].standard_error == 0.01);
  CHECK(std::isnan(results.values[1].standard_error));
  write_changed(path, bad, [](auto& d) { d["held_out"]["tables"] = 3; });
  CHECK_THROWS_WITH(read_model(bad), Catch::StartsWith(bad.string() + ": "));
}

TEST_CASE("a model says what shapes it has seen, and damaged ones are refused") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "model.safetensors", bad = folder.path() / "bad.safetensors";
  Model model = axis_model(frame::DepthChoice::none);
  model.seen = {.mean = {1, -2, 0.1}, .deviation = {1, 0, 3}, .limit = 2.5};
  model.gain = {0.25, 0.5, {-0.1, 0, 0.2}};
  write_model(path, model);
  const Model back = read_model(path);
  CHECK(back.seen.mean == model.seen.mean);
  CHECK(back.seen.deviation == model.seen.deviation);
  CHECK(back.seen.limit == 2.5);
  CHECK(back.gain.intercept == 0.25);
  CHECK(back.gain.slope == 0.5);
  CHECK(back.gain.residuals == model.gain.residuals);
  write_changed(path, bad, [](auto& d) { d["frame"]["gain"]["residuals"] = {0.1, -0.1}; });
  CHECK_THROWS_WITH(read_model(bad), bad.string() + ": frame: the residuals in gain are not ascending quantiles");
  write_changed(path, bad, [](auto& d) { d["frame"]["gain"]["residuals"] = {0.1}; });
  CHECK_THROWS_WITH(read_model(bad), bad.string() + ": frame: the residuals in gain are not ascending quantiles");
  write_changed(path, bad, [](auto& d) { d["frame"]["seen"]["deviation"] = {1, 2}; });
  CHECK_THROWS_WITH(read_model(bad), bad.string() + ": frame: seen has 3 means and 2 deviations, expected 3");
  write_changed(path, bad, [](auto& d) { d["frame"]["seen"]["mean"] = nlohmann::json::array(); });
  CHECK_THROWS_WITH(read_model(bad), bad.string() + ": frame: seen has 0 means and 3 deviations, expected 3");
  write_changed(path, bad, [](auto& d) { d["frame"]["seen"]["deviation"][1] = -0.5; });
  CHECK_THROWS_WITH(read_model(bad), bad.string() + ": frame: a deviation or the limit in seen is negative");
  write_changed(path, bad, [](auto& d) { d["frame"]["seen"]["mean"] = {1, 2}; });
  CHECK_THROWS_WITH(read_model(bad), bad.string() + ": frame: seen has 2 means and 3 deviations, expected 3");
  write_changed(path, bad, [](auto& d) { d["frame"]["seen"]["limit"] = -1; });
  CHECK_THROWS_WITH(read_model(bad), bad.string() + ": frame: a deviation or the limit in seen is negative");
  // A number that is not finite cannot be said in JSON.
  const SafetensorsFile good(path);
  auto metadata = good.metadata();
  std::string& description = metadata.at("svnet");
  description.replace(description.find("2.5"), 3, "1e999");
  write_safetensors(bad, good.tensors(), metadata);
  CHECK_THROWS_WITH(read_model(bad), Catch::StartsWith(bad.string() + ": ") && Catch::Contains("1e999"));
  write_changed(path, bad, [](auto& d) { d["frame"]["seen"].erase("deviation"); });
  CHECK_THROWS_WITH(read_model(bad), Catch::StartsWith(bad.string() + ": "));
}

TEST_CASE("a model in a frame with turns is read with the same bits, its backbone too") {
  const TemporaryFolder temporary;
  const auto path = temporary.path() / "model.safetensors";
  const auto [choice, depth] = GENERATE(std::pair{frame::FrameChoice::turned, frame::DepthChoice::none},
                                        std::pair{frame::FrameChoice::turned_axis, frame::DepthChoice::none},
                                        std::pair{frame::FrameChoice::turned_axis, frame::DepthChoice::heights});
  const Model model = turned_model(choice, depth);
  write_model(path, model);
  const Model back = read_model(path);
  CHECK(back.frame == choice);
  CHECK(back.depth == depth);
  CHECK(back.backbone == "tiny_xception");
  CHECK(back.backbone_output == "projection");
  CHECK(frame_spec(back).components == 2);
  CHECK(back.preprocessing.height == 96);
  for (const auto& [name, value] : model.head_parameters.items()) CHECK(equal(back.head_parameters.at(name), value));
  for (const auto& [name, value] : model.backbone_parameters.items())
    CHECK(equal(back.backbone_parameters.at(name), value));
  const auto description = TensorFile::read(path, "model").description();
  CHECK(description.at("frame") == nlohmann::json{{"kind", name_of(choice)}, {"depth", name_of(depth)}});
  CHECK(description.contains("backbone"));
  CHECK_FALSE(description.contains("angles"));
}

TEST_CASE("a model keeps the ranges of a backbone that multiplies in int8, and damaged ones are refused") {
  const TemporaryFolder temporary;
  const auto path = temporary.path() / "model.safetensors", bad = temporary.path() / "bad.safetensors";
  Model model = small_model();
  write_model(path, model);
  CHECK(read_model(path).backbone_ranges == nullptr);
  const Backbone exact = random_backbone("tiny_xception", "", 2), coarse = in_int8_for_noise(exact, 7);
  model.backbone_ranges = coarse.network().options().ranges;
  REQUIRE(model.backbone_ranges != nullptr);
  write_model(path, model);
  const Model back = read_model(path);
  REQUIRE(back.backbone_ranges != nullptr);
  CHECK(*back.backbone_ranges == *model.backbone_ranges);
  const Tensor image = Tensor::full({1, 96, 96, 3}, 0.5);
  const Inference network(back.backbone_graph, back.backbone_parameters, back.backbone_graph.output(),
                          inference_options(back));
  CHECK(network.precision() == kernels::Precision::int8);
  CHECK(equal(network.run({image}), coarse.features(image)));
  CHECK_FALSE(equal(network.run({image}), exact.features(image)));

  const auto read_changed = [&](const std::function<void(nlohmann::json&)>& change) {
    write_changed(path, bad, change);
    static_cast<void>(read_model(bad));
  };
  CHECK_THROWS_WITH(read_changed([](auto& d) { d["backbone"]["ranges"][0]["channels"] = 5; }),
                    Catch::StartsWith(bad.string()) && Catch::Contains("expected 5"));
  CHECK_THROWS_WITH(read_changed([](auto& d) { d["backbone"]["ranges"][0]["channels"] = -1; }),
                    Catch::StartsWith(bad.string()) && Catch::Contains("has -1 channels"));
  CHECK_THROWS_WITH(read_changed([](auto& d) { d["backbone"]["ranges"][0]["layer"] = "other"; }),
                    Catch::StartsWith(bad.string()) && Catch::Contains("ranges/other/low"));
  ActivationRanges broken = *model.backbone_ranges;
  broken.begin()->second.high[0] = INFINITY;
  model.backbone_ranges = std::make_shared<ActivationRanges>(broken);
  CHECK_THROWS_WITH(write_model(bad, model), Catch::StartsWith(bad.string()) && Catch::Contains("is not finite at 0"));
}

TEST_CASE("a damaged model in a frame with turns is refused") {
  const TemporaryFolder temporary;
  const auto path = temporary.path() / "model.safetensors", bad = temporary.path() / "bad.safetensors";
  const Model good = turned_model(frame::FrameChoice::turned, frame::DepthChoice::none);
  write_model(path, good);
  const auto read_changed = [&](const std::function<void(nlohmann::json&)>& change) {
    write_changed(path, bad, change);
    static_cast<void>(read_model(bad));
  };
  CHECK_THROWS_WITH(read_changed([](auto& d) { d["frame"]["kind"] = "turned_axis"; }),
                    Catch::Contains("the head does not take the ") && Catch::Contains(" inputs of a camera pose"));
  CHECK_THROWS_WITH(read_changed([](auto& d) { d["frame"]["depth"] = "heights"; }),
                    bad.string() + ": frame: the frame turned has no depth, expected none, got heights");
  CHECK_THROWS_WITH(read_changed([](auto& d) { d.erase("backbone"); }),
                    Catch::StartsWith(bad.string()) && Catch::Contains("backbone"));
  CHECK_THROWS_WITH(read_changed([](auto& d) { d["backbone"]["output"] = "avg_pool"; }),
                    Catch::Contains("the head does not take the "));
  CHECK_THROWS_WITH(read_changed([](auto& d) { d["backbone"]["output"] = "projektion"; }),
                    Catch::StartsWith(bad.string()) && Catch::Contains("'projection'"));
  CHECK_THROWS_WITH(read_changed([](auto& d) { d["preprocessing"]["width"] = 64; }),
                    bad.string() + ": images of 96x64 cannot be turned; only square ones can");
  CHECK_THROWS_WITH(read_changed([](auto& d) { d["preprocessing"]["width"] = d["preprocessing"]["height"] = 64; }),
                    bad.string() + ": the backbone does not take images of 64x64, as preprocessing makes them");
  Model narrow = good;
  narrow.backbone_parameters.set("projection/bias", Tensor::zeros({3}));
  write_model(bad, narrow);
  CHECK_THROWS_WITH(read_model(bad), bad.string() + ": tensor 'backbone/projection/bias' is 3, expected 2");
}

TEST_CASE("the file of a model in the frame camera does not say a frame") {
  const TemporaryFolder temporary;
  const auto path = temporary.path() / "model.safetensors";
  write_model(path, small_model());
  const auto description = TensorFile::read(path, "model").description();
  CHECK_FALSE(description.contains("frame"));
  std::vector<std::string> members;
  for (const auto& [key, value] : description.items()) members.push_back(key);
  CHECK(members == std::vector<std::string>{"angles", "backbone", "checksums", "format", "head", "input_fingerprint",
                                            "kind", "preprocessing"});
}

TEST_CASE("every kind of layer survives JSON") {
  Graph g;
  const NodeId image = g.input("image", {16, 16, 3}), extra = g.input("extra", {2});
  NodeId x = g.add("pad", ZeroPadding2dLayer{Padding::of(0, 1, 2, 3)}, {image});
  x = g.add("conv",
            Conv2dLayer{.filters = 4,
                        .kh = 3,
                        .kw = 2,
                        .stride_h = 2,
                        .stride_w = 1,
                        .padding = Padding::same(),
                        .activation = Activation::relu6},
            {x});
  x = g.add("dw",
            DepthwiseConv2dLayer{.kh = 3, .kw = 3, .multiplier = 2, .padding = Padding::of(1, 0, 1, 0), .bias = false},
            {x});
  x = g.add("sep", SeparableConv2dLayer{.filters = 5, .kh = 3, .kw = 3}, {x});
  x = g.add("bn", BatchNormLayer{{.momentum = 0.1, .epsilon = 1e-5, .convention = MomentumConvention::pytorch}}, {x});
  const NodeId a = g.add("act", ActivationLayer{Activation::sigmoid}, {x});
  const NodeId swish = g.add("swish", ActivationLayer{Activation::hard_swish}, {x});
  x = g.add("sum", AddLayer{}, {x, a});
  x = g.add("product", MultiplyLayer{}, {x, swish});
  x = g.add("max", Pool2dLayer{.kind = PoolKind::max, .window = {.kh = 2, .kw = 2, .stride_h = 2, .stride_w = 2}}, {x});
  x = g.add("mean",
            Pool2dLayer{.kind = PoolKind::average,
                        .window = {.kh = 2, .kw = 2, .stride_h = 1, .stride_w = 1, .padding = Padding::same()}},
            {x});
  const NodeId flat = g.add("flat", FlattenLayer{}, {x});
  const NodeId largest = g.add("gmax", GlobalPool2dLayer{.kind = PoolKind::max, .keep_dimensions = true}, {x});
  const NodeId shaped = g.add("shaped", ReshapeLayer{{5}}, {largest});
  const NodeId average = g.add("gavg", GlobalPool2dLayer{}, {x});
  x = g.add("all", ConcatLayer{}, {flat, shaped, average, extra});
  x = g.add("drop", DropoutLayer{0.25}, {x});
  g.add("dense", DenseLayer{.units = 3, .bias = false, .activation = Activation::softmax}, {x});

  const auto json = graph_to_json(g);
  const Graph back = graph_from_json(json, "test");
  CHECK(graph_to_json(back) == json);
  REQUIRE(back.nodes().size() == g.nodes().size());
  for (std::size_t i = 0; i < g.nodes().size(); ++i) CHECK(back.nodes()[i].shape == g.nodes()[i].shape);
}

TEST_CASE("a wrong graph is refused with its node and attribute") {
  auto json = graph_to_json(sv_net({.features = 4, .width = 2}));
  auto broken = json;
  broken[2]["units"] = "many";
  CHECK_THROWS_WITH(graph_from_json(broken, "f"), Catch::Contains("f: node 2 'mlp1_1_fc': attribute 'units': "));
  broken = json;
  broken[2]["kind"] = "Denze";
  CHECK_THROWS_WITH(graph_from_json(broken, "f"),
                    Catch::Contains("unknown kind of layer 'Denze', did you mean 'Dense'?"));
  broken = json;
  broken[2]["activation"] = "hardswish";
  CHECK_THROWS_WITH(graph_from_json(broken, "f"), Catch::Contains("f: node 2 'mlp1_1_fc': attribute 'activation': ") &&
                                                      Catch::Contains("did you mean 'hard_swish'?"));
  broken = json;
  broken[3]["inputs"] = {"nobody"};
  CHECK_THROWS_WITH(graph_from_json(broken, "f"), Catch::Contains("f: node 3 'mlp1_1_bn': [graph] no layer 'nobody'"));
  // A node without a usable name is named by its number alone.
  broken = json;
  broken[2].erase("name");
  CHECK_THROWS_WITH(graph_from_json(broken, "f"), Catch::StartsWith("f: node 2: ") && Catch::Contains("name"));
  broken[2]["name"] = 7;
  CHECK_THROWS_WITH(graph_from_json(broken, "f"), Catch::StartsWith("f: node 2: "));
  broken[2] = "mlp1_1_fc";
  CHECK_THROWS_WITH(graph_from_json(broken, "f"), Catch::StartsWith("f: node 2: "));
  for (const auto& no_graph : {nlohmann::json::array(), nlohmann::json::object(), nlohmann::json("graph")})
    CHECK_THROWS_WITH(graph_from_json(no_graph, "f"), "f: the graph is not a list of nodes");
}

TEST_CASE("padding in JSON is a name or four sizes") {
  Graph g;
  g.add("pad", ZeroPadding2dLayer{Padding::of(0, 1, 2, 3)}, {g.input("image", {4, 4, 1})});
  auto json = graph_to_json(g);
  CHECK(json[1]["padding"] == nlohmann::json{0, 1, 2, 3});
  const std::string start = "f: node 1 'pad': attribute 'padding': ";
  json[1]["padding"] = name_of(Padding::Kind::explicit_);
  CHECK_THROWS_WITH(graph_from_json(json, "f"), start + "explicit padding is a list of four numbers");
  json[1]["padding"] = "sam";
  CHECK_THROWS_WITH(graph_from_json(json, "f"), Catch::StartsWith(start) && Catch::Contains("did you mean 'same'?"));
  json[1]["padding"] = {0, 1, 2};
  CHECK_THROWS_WITH(graph_from_json(json, "f"), Catch::StartsWith(start));
}

TEST_CASE("a file that is not a model, or has other tensors, is refused") {
  const TemporaryFolder temporary;
  const auto path = temporary.path() / "model.safetensors";
  write_checkpoint(path, {.input_fingerprint = "x", .metrics = "", .parameters = {}, .optimizer = {}});
  CHECK_THROWS_WITH(read_model(path), path.string() + ": is a checkpoint, expected a model");

  TensorFile wrong;
  wrong.add("a", Tensor::zeros({2}));
  const auto other = temporary.path() / "other.safetensors";
  write_safetensors(other, {}, {});
  CHECK_THROWS_WITH(read_model(other), Catch::Contains("not one that svnet wrote"));

  Model model = small_model();
  model.head_parameters.set("score/extra", Tensor::zeros({1}));
  model.head_parameters.set("mlp1_1_fc/bias", Tensor::zeros({9}));
  write_model(path, model);
  CHECK_THROWS_WITH(read_model(path), path.string() + ": tensor 'head/mlp1_1_fc/bias' is 9, expected 8");
  // Values that are not finite are neither written nor read.
  const std::string not_finite = path.string() + ": tensor 'head/mlp1_1_fc/bias' holds a value that is not finite at 3";
  model = small_model();
  write_model(path, model);
  model.head_parameters.at("mlp1_1_fc/bias").data<float>()[3] = std::nanf("");
  CHECK_THROWS_WITH(write_model(path, model), not_finite);
  const SafetensorsFile good(path);
  std::vector<float> bias(8, std::nanf(""));
  std::fill_n(bias.begin(), 3, 1.0f);
  std::vector<SafetensorsTensor> tensors = good.tensors();
  for (auto& tensor : tensors)
    if (tensor.name == "head/mlp1_1_fc/bias") tensor.bytes = std::as_bytes(std::span(bias));
  const auto bad = temporary.path() / "bad.safetensors";
  auto metadata = good.metadata();
  nlohmann::json description = nlohmann::json::parse(metadata.at("svnet"));
  description.erase("checksums");
  metadata.at("svnet") = description.dump();
  write_safetensors(bad, tensors, metadata);
  CHECK_THROWS_WITH(read_model(bad),
                    Catch::EndsWith("tensor 'head/mlp1_1_fc/bias' holds a value that is not finite at 3"));
}

TEST_CASE("a checkpoint is read as it was written") {
  const TemporaryFolder temporary;
  const auto path = temporary.path() / "checkpoint.safetensors";
  const Graph graph = sv_net({.features = 4, .width = 2});
  const Checkpoint saved{.input_fingerprint = "f",
                         .epoch = 3,
                         .steps = 17,
                         .best_loss = 0.125,
                         .best_epoch = 4,
                         .metrics = "a,b\n1,2\n",
                         .parameters = initial_parameters(graph, 1),
                         .optimizer = {Tensor::full({2, 2}, 0.5)}};
  CHECK(read_checkpoint_fingerprint(path).empty());
  write_checkpoint(path, saved);
  CHECK(read_checkpoint_fingerprint(path) == "f");
  const Checkpoint back = read_checkpoint(path, graph, {Shape{2, 2}});
  CHECK(back.epoch == 3);
  CHECK(back.steps == 17);
  CHECK(back.best_loss == 0.125);
  CHECK(back.best_epoch == 4);
  CHECK(back.metrics == saved.metrics);
  CHECK(equal(back.optimizer[0], saved.optimizer[0]));
  const Parameters alone = read_checkpoint_parameters(path, graph);
  for (const auto& [name, value] : saved.parameters.items()) {
    CHECK(equal(back.parameters.at(name), value));
    CHECK(equal(alone.at(name), value));
  }
  CHECK_THROWS_WITH(read_checkpoint(path, graph, {Shape{3}}),
                    Catch::Contains("tensor 'optimizer/0' is 2x2, expected 3"));
}
