#include "exports/exports.h"

#include <array>
#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <protozero/pbf_reader.hpp>
#include <protozero/pbf_writer.hpp>

#include "io/onnx/onnx_fields.h"
#include "io/onnx/onnx_graph.h"
#include "io/onnx/onnx_reader.h"
#include "small_model.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::exports;
using Catch::Contains;
using frame::FrameChoice;
using models::AngleEncoding;

namespace {

/// The names of the files in a folder.
std::vector<std::string> files_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::ranges::sort(names);
  return names;
}

/// A message of ONNX with an unknown field in it and in each message that it has.
std::string with_unknown_fields(const std::string& message, const std::string& kind = "model") {
  using namespace io::onnx;
  // The messages that a message has, by its field: what svnet reads of onnx.proto.
  static const std::map<std::pair<std::string, protozero::pbf_tag_type>, std::string> kMessages{
      {{"model", kGraph}, "graph"},        {{"model", kOpsetImport}, "opset"},
      {{"model", kMetadata}, "entry"},     {{"graph", kNode}, "node"},
      {{"graph", kInitializer}, "tensor"}, {{"graph", kInput}, "port"},
      {{"graph", kOutput}, "port"},        {{"node", kAttribute}, "attribute"},
      {{"port", kPortType}, "type"},       {{"type", kTensorType}, "tensor type"},
      {{"tensor type", kShape}, "shape"},  {{"shape", kDimension}, "dimension"}};
  std::string result;
  protozero::pbf_writer to(result);
  to.add_string(99, "unknown");
  protozero::pbf_reader from(message);
  while (from.next()) {
    const auto tag = from.tag();
    switch (from.wire_type()) {
      case protozero::pbf_wire_type::varint:
        to.add_uint64(tag, from.get_uint64());
        break;
      case protozero::pbf_wire_type::fixed32:
        to.add_fixed32(tag, from.get_fixed32());
        break;
      default: {
        const std::string bytes = from.get_bytes();
        const auto found = kMessages.find({kind, tag});
        to.add_bytes(tag, found == kMessages.end() ? bytes : with_unknown_fields(bytes, found->second));
      }
    }
  }
  return result;
}

}  // namespace

TEST_CASE("an ONNX export of a whole model agrees with it, for each encoding of angles", "[slow]") {
  const TemporaryFolder folder;
  for (const auto encoding : {AngleEncoding::radians, AngleEncoding::sphere, AngleEncoding::harmonics})
    for (const int symmetries : {1, 8})
      for (const bool preprocessing : {false, true}) {
        CAPTURE(name_of(encoding), symmetries, preprocessing);
        Model model = small_model(encoding);
        model.symmetries = symmetries;
        const Agreement result = export_onnx(model, folder.path() / "model.onnx", {.preprocessing = preprocessing});
        CHECK(result.samples == 4);
        CHECK(result.poses == 20);
        CHECK(result.largest_difference < 1e-6);
        CHECK(result.same_best == 4);
      }
  CHECK(files_in(folder.path()) == std::vector<std::string>{"model.onnx"});
}

TEST_CASE("parts, precisions and opsets of an ONNX export agree with the model") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "part.onnx";
  for (const auto precision : {StoredPrecision::f32, StoredPrecision::bf16, StoredPrecision::int8}) {
    CAPTURE(name_of(precision));
    const double bound = bound_of(precision);
    CHECK(export_onnx(small_model(), path, {.part = ModelPart::all, .precision = precision}).largest_difference <=
          bound);
    CHECK(export_onnx(small_model(), path, {.part = ModelPart::head, .precision = precision}).largest_difference <=
          bound);
    for (const auto frame : {FrameChoice::turned, FrameChoice::turned_axis}) {
      const Model turned = small_turned_model(frame);
      CHECK(export_onnx(turned, path, {.part = ModelPart::head, .precision = precision}).largest_difference <= bound);
    }
    const Agreement axis = export_onnx(small_axis_model(), path, {.part = ModelPart::head, .precision = precision});
    CHECK(axis.largest_difference <= 1e-6);  // so small a head is not rounded
    Model knows = small_turned_model();
    set_small_next_head(knows);
    CHECK(export_onnx(knows, path, {.part = ModelPart::next, .precision = precision}).largest_difference <= bound);
  }
  CHECK(export_onnx(small_model(), path, {.part = ModelPart::backbone}).largest_difference < 1e-6);
  CHECK(export_onnx(small_turned_model(), path, {.part = ModelPart::backbone}).largest_difference < 1e-6);
  for (int opset = 13; opset <= 17; ++opset) {
    static_cast<void>(export_onnx(small_model(), path, {.opset = opset}));
    int written = 0;
    std::ifstream file(path, std::ios::binary);
    static_cast<void>(io::parse_onnx("part", std::string(std::istreambuf_iterator<char>(file), {}), &written));
    CHECK(written == opset);
  }
}

TEST_CASE("an ONNX export of a head that averages over the orientations of the image agrees with the model") {
  const TemporaryFolder folder;
  for (const auto encoding : {AngleEncoding::radians, AngleEncoding::harmonics}) {
    CAPTURE(name_of(encoding));
    Model model = small_model(encoding);
    model.symmetries = 8;
    const Agreement result = export_onnx(model, folder.path() / "head.onnx", {.part = ModelPart::head});
    CHECK(result.poses == 20);
    CHECK(result.largest_difference < 1e-6);
  }
}

TEST_CASE("exports of parts that a model does not have are refused") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "model.onnx";
  CHECK_THROWS_WITH(export_onnx(small_axis_model(), path, {}),
                    Contains("frame axis, which has no network for the image; export its head with --part head"));
  CHECK_THROWS_WITH(export_onnx(small_turned_model(), path, {}),
                    Contains("frame turned") && Contains("--part backbone and --part head"));
  CHECK_THROWS_WITH(export_keras(small_axis_model(), path, {}), Contains("export its head with --part head"));
  CHECK_THROWS_WITH(export_onnx(small_axis_model(), path, {.part = ModelPart::next}),
                    Contains("does not know which view to take next"));
  CHECK_THROWS_WITH(export_keras(small_turned_model(), path, {}), Contains("--part backbone and --part head"));
  Model symmetric = small_model();
  symmetric.symmetries = 8;
  CHECK_THROWS_WITH(export_keras(symmetric, path, {}), Contains("averages over the orientations of the image"));
  CHECK_THROWS_WITH(export_onnx(small_model(), path, {.opset = 12}), Contains("ONNX opset 12 is not one of 13 to 17"));
  CHECK_THROWS_WITH(export_onnx(small_model(), path, {.opset = 18}), Contains("ONNX opset 18 is not one of 13 to 17"));
  CHECK(files_in(folder.path()).empty());
}

TEST_CASE("an export that computes something else is refused") {
  const Model model = small_model();
  const auto constant = [](float value) {
    return [value](const Sample& sample) { return std::vector<float>(sample.poses.size(), value); };
  };
  CHECK_THROWS_WITH(agreement("out.onnx", model, ModelPart::all, constant(0.5f), 1e-5),
                    Contains("out.onnx: the export does not compute what the model computes") &&
                        Contains("bound 1e-05") && Contains("nothing was written"));
  CHECK_THROWS_WITH(agreement("out.onnx", model, ModelPart::all, constant(std::nanf("")), 1e-5),
                    Contains("largest difference nan"));
  CHECK_THROWS_WITH(agreement(
                        "out.onnx", model, ModelPart::all, [](const Sample&) { return std::vector<float>(3); }, 1e-5),
                    Contains("the export gives 3 values, the model 20"));
}

TEST_CASE("a Keras export agrees with the model, and is a folder that appears as a whole") {
  const TemporaryFolder folder;
  for (const bool preprocessing : {false, true}) {
    const auto path = folder.path() / (preprocessing ? "raw" : "prepared");
    const Agreement whole = export_keras(small_model(AngleEncoding::sphere), path, {.preprocessing = preprocessing});
    CHECK(whole.largest_difference < 1e-6);
    CHECK(files_in(path) == std::vector<std::string>{"angles.py", "config.json", "metadata.json", "model.weights.h5"});
  }
  CHECK(export_keras(small_model(), folder.path() / "backbone", {.part = ModelPart::backbone}).largest_difference <
        1e-6);
  CHECK(files_in(folder.path() / "backbone").size() == 3);
  Model symmetric = small_model();
  symmetric.symmetries = 8;
  CHECK(export_keras(symmetric, folder.path() / "head", {.part = ModelPart::head}).largest_difference < 1e-6);
  CHECK(export_keras(small_axis_model(), folder.path() / "axis", {.part = ModelPart::head}).largest_difference < 1e-6);
  Model knows = small_axis_model();
  set_small_next_head(knows);
  CHECK(export_keras(knows, folder.path() / "next", {.part = ModelPart::next}).largest_difference < 1e-6);
  CHECK_THROWS_WITH(export_keras(small_model(), folder.path() / "raw", {}), Contains("raw"));
}

TEST_CASE("a model file with smaller weights agrees with the model") {
  const TemporaryFolder folder;
  const auto size = [&](StoredPrecision precision) {
    const auto path = folder.path() / "model.safetensors";
    const Agreement result = export_safetensors(small_model(), path, precision);
    CHECK(result.largest_difference <= bound_of(precision));
    CHECK(io::read_model(path).precision == precision);
    return static_cast<double>(std::filesystem::file_size(path));
  };
  const double f32 = size(StoredPrecision::f32);
  CHECK(size(StoredPrecision::bf16) < 0.6 * f32);
  CHECK(size(StoredPrecision::int8) < 0.4 * f32);
  const Agreement axis = export_safetensors(small_axis_model(), folder.path() / "axis", StoredPrecision::int8);
  CHECK(axis.largest_difference == 0);
}

TEST_CASE(
    "a model that multiplies in int8 is exported, in other precisions too unless the weights then differ too much") {
  const TemporaryFolder folder;
  Model model = small_model();
  model.backbone_ranges =
      models::in_int8_for_noise(models::random_backbone("tiny_xception", "", 2), 7).network().options().ranges;
  // In ONNX and Keras it multiplies in float32.
  CHECK(export_onnx(model, folder.path() / "m.onnx", {}).largest_difference <= bound_of(StoredPrecision::f32));
  const auto path = folder.path() / "m.safetensors";
  CHECK(export_safetensors(model, path, StoredPrecision::f32).largest_difference == 0);
  CHECK(*io::read_model(path).backbone_ranges == *model.backbone_ranges);
  for (const StoredPrecision precision : {StoredPrecision::bf16, StoredPrecision::int8}) {
    std::filesystem::remove(path);
    try {
      CHECK(export_safetensors(model, path, precision).largest_difference <= bound_of(precision));
      CHECK(io::read_model(path).backbone_ranges != nullptr);
    } catch (const Error& refused) {  // rounded twice
      CHECK_THAT(refused.what(), Contains("does not compute what the model computes"));
      CHECK_FALSE(std::filesystem::exists(path));
    }
  }
}

TEST_CASE("bytes that are not an ONNX model are refused") {
  CHECK_THROWS_WITH(io::parse_onnx("a.onnx", "no model"), Contains("a.onnx: is not an ONNX model"));
  CHECK_THROWS_WITH(io::parse_onnx("a.onnx", ""), Contains("it has no graph"));
  io::OnnxGraph graph;
  const auto read = [&] { return io::parse_onnx("a.onnx", io::onnx_bytes("a.onnx", graph, 13)); };
  CHECK_THROWS_WITH(read(), "a.onnx: is not an ONNX model: it has no graph");
  graph.add("Relu", "y", {"x"});
  CHECK_THROWS_WITH(read(), "a.onnx: is not an ONNX model: it has no graph");
  graph.outputs.push_back({"y", {}});
  CHECK(read().nodes.size() == 1);
}

TEST_CASE("an ONNX graph is read as it was written, and what svnet does not write is skipped") {
  io::OnnxGraph graph;
  const std::array<float, 2> floats{1, 2};
  graph.inputs.push_back({"x", {"N", Index{2}}});
  graph.outputs.push_back({"y", {"N", Index{2}}});
  graph.add("Op", "y", {"x", graph.add_constant("c", {2}, floats)},
            {{"real", 0.5f}, {"whole", std::int64_t{-3}}, {"several", std::vector<std::int64_t>{1, -2}}});
  graph.metadata["key"] = "value";
  const std::string written = io::onnx_bytes("a.onnx", graph, 14);
  // Every message gets a field of a number that no message of ONNX has.
  const auto check_read = [&](const std::string& bytes) {
    const io::OnnxGraph back = io::parse_onnx("a.onnx", bytes);
    REQUIRE(back.nodes.size() == 1);
    CHECK(back.nodes[0].op == "Op");
    CHECK(back.nodes[0].name == "y");
    CHECK(back.nodes[0].inputs == std::vector<std::string>{"x", "c"});
    CHECK(back.nodes[0].attributes == graph.nodes[0].attributes);
    REQUIRE(back.constants.size() == 1);
    CHECK(back.constants[0].name == "c");
    CHECK(back.constants[0].shape == std::vector<Index>{2});
    CHECK(back.constants[0].bytes == graph.constants[0].bytes);
    REQUIRE(back.inputs.size() == 1);
    CHECK(back.inputs[0].name == "x");
    CHECK(back.inputs[0].shape == graph.inputs[0].shape);
    CHECK(back.metadata == graph.metadata);
  };
  check_read(written);
  check_read(with_unknown_fields(written));
}
