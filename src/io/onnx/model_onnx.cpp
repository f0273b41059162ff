#include "io/onnx/model_onnx.h"

#include "base/error.h"
#include "frame/next_inputs.h"
#include "io/onnx/layer_nodes.h"
#include "io/onnx/pose_nodes.h"
#include "models/preprocessing_layer.h"
#include "nn/runtime/folding.h"
#include "view/symmetry.h"

namespace svnet::io {
namespace {

using Integers = std::vector<std::int64_t>;

constexpr const char* kImage = "image";
constexpr const char* kFeatures = "features";
constexpr const char* kPoses = "poses_deg";
constexpr const char* kScores = "scores";

class ModelEmission {
 public:
  ModelEmission(const Model& model, const OnnxOptions& options) : model_(model), options_(options) {}

  OnnxGraph graph() {
    add_metadata();
    switch (options_.part) {
      case ModelPart::all:
        add_all();
        break;
      case ModelPart::backbone:
        add_output("Identity", kFeatures, layers("backbone/").rows_of(backbone(image("N"))), {"N", backbone_size()});
        break;
      case ModelPart::head:
        add_head();
        break;
      case ModelPart::next:
        add_pose_head(model_.next_head, model_.next_parameters, frame::next_input_count(frame_spec(model_)));
        break;
    }
    return std::move(to_);
  }

 private:
  OnnxLayers layers(const char* prefix) { return {to_, options_.precision, prefix}; }

  /// The value under the name of an output.
  void add_output(const char* op, const char* name, const std::string& value,
                  std::vector<std::variant<Index, std::string>> shape,
                  std::vector<std::pair<std::string, OnnxAttribute>> attributes = {}) {
    to_.add(op, name, {value}, std::move(attributes));
    to_.outputs.push_back({name, std::move(shape)});
  }

  /// The image as (N, 3, H, W).
  OnnxValue image(std::variant<Index, std::string> batch) {
    const models::Preprocessing& p = model_.preprocessing;
    to_.inputs.push_back({kImage, {std::move(batch), p.height, p.width, Index{3}}});
    return {.name = to_.add("Transpose", "image/channels_first", {kImage}, {{"perm", Integers{0, 3, 1, 2}}}),
            .shape = {p.height, p.width, 3},
            .channels_first = {p.height, p.width, 3}};
  }

  std::string poses() {
    to_.inputs.push_back({kPoses, {"M", Index{2}}});
    return add_angles(to_, kPoses, model_.angles, model_.symmetries);
  }

  Index backbone_size() const {
    return element_count(model_.backbone_graph.node(model_.backbone_graph.find(model_.backbone_output)).shape);
  }

  OnnxValue backbone(const OnnxValue& image) {
    models::GraphWithParameters whole{model_.backbone_graph, model_.backbone_parameters};
    if (options_.preprocessing)
      whole = models::with_preprocessing(model_.preprocessing.mode, whole.graph, whole.parameters);
    const FoldedGraph network = folded(whole.graph, whole.parameters, whole.graph.find(model_.backbone_output));
    return layers("backbone/").add(network.graph, network.parameters, {image});
  }

  /// The scores of the head, (M, 1), or (symmetries, M, 1).
  std::string head(const std::vector<OnnxValue>& inputs) { return head(model_.head, model_.head_parameters, inputs); }
  std::string head(const Graph& graph, const Parameters& parameters, const std::vector<OnnxValue>& inputs) {
    const FoldedGraph network = folded(graph, parameters, graph.output());
    OnnxLayers to = layers("head/");
    return to.rows_of(to.add(network.graph, network.parameters, inputs));
  }

  /// (1, 3, S, S) -> (symmetries, 3, S, S), the images of view/symmetry.h.
  OnnxValue all_symmetries(OnnxValue image) {
    std::vector<std::string> images;
    const auto flipped = [&](const std::string& from, const std::string& name, std::int64_t axis) {
      const std::string steps = to_.add_constant(name + ":step", {1}, Integers{-1});
      const std::string start = to_.add_constant(name + ":start", {1}, Integers{-1});
      const std::string end = to_.add_constant(name + ":end", {1}, Integers{std::int64_t{INT32_MIN}});
      return to_.add("Slice", name, {from, start, end, to_.add_constant(name + ":axis", {1}, Integers{axis}), steps});
    };
    constexpr std::int64_t kRows = 2, kColumns = 3;
    for (int symmetry = 0; symmetry < model_.symmetries; ++symmetry) {
      const std::string name = joined("image/symmetry", symmetry);
      std::string value = image.name;
      if (symmetry >= 4) value = flipped(value, name + "/mirrored", kColumns);
      const int quarters = symmetry % 4;
      if (quarters % 2 == 1)
        value = to_.add("Transpose", name + "/transposed", {value}, {{"perm", Integers{0, 1, 3, 2}}});
      if (quarters == 1 || quarters == 2) value = flipped(value, name + "/rows", kRows);
      if (quarters == 2 || quarters == 3) value = flipped(value, name + "/columns", kColumns);
      images.push_back(value);
    }
    image.name = to_.add("Concat", "image/symmetries", images, {{"axis", std::int64_t{0}}});
    return image;
  }

  /// Features of all symmetries as (symmetries, 1, D).
  OnnxValue of_symmetries(const std::string& features) {
    const Integers shape{model_.symmetries, 1, backbone_size()};
    const std::string sizes = to_.add_constant("features/shape", {3}, shape);
    return {.name = to_.add("Reshape", "features/of_symmetries", {features, sizes}), .shape = {backbone_size()}};
  }

  void add_scores(const OnnxValue& features, const std::string& angles) {
    const std::string scores = head({features, {.name = angles, .shape = {angle_count(model_.angles)}}});
    if (model_.symmetries == 1)
      add_output("Identity", kScores, scores, {"M", Index{1}});
    else
      add_output("ReduceMean", kScores, scores, {"M", Index{1}},
                 {{"axes", Integers{0}}, {"keepdims", std::int64_t{0}}});
  }

  void add_all() {
    OnnxValue seen = image(Index{1});
    const std::string angles = poses();
    if (model_.symmetries > 1) seen = all_symmetries(seen);
    OnnxValue features = backbone(seen);
    if (model_.symmetries > 1) features = of_symmetries(layers("backbone/").rows_of(features));
    add_scores(features, angles);
  }

  /// A head on the inputs of poses.
  void add_pose_head(const Graph& graph, const Parameters& parameters, Index inputs) {
    to_.inputs.push_back({"pose", {"M", inputs}});
    add_output("Identity", kScores, head(graph, parameters, {{.name = "pose", .shape = {inputs}}}), {"M", Index{1}});
  }

  void add_head() {
    if (model_.frame != frame::FrameChoice::camera)
      return add_pose_head(model_.head, model_.head_parameters, frame::input_count(frame_spec(model_)));
    const bool one = model_.symmetries == 1;
    to_.inputs.push_back(
        {kFeatures, {one ? std::variant<Index, std::string>("F") : Index{1}, model_.symmetries * backbone_size()}});
    const std::string angles = poses();
    add_scores(one ? OnnxValue{.name = kFeatures, .shape = {backbone_size()}} : of_symmetries(kFeatures), angles);
  }

  void add_metadata() {
    const models::Preprocessing& p = model_.preprocessing;
    to_.metadata["svnet.part"] = name_of(options_.part);
    to_.metadata["svnet.frame"] = name_of(model_.frame);
    to_.metadata["svnet.precision"] = name_of(options_.precision);
    if (frame::has_backbone(model_.frame))
      to_.metadata["svnet.image"] =
          joined("RGB, ", p.height, " x ", p.width, ", resized by ", name_of(p.interpolation), ", pixels ",
                 options_.preprocessing ? "0 to 255" : joined("preprocessed as ", name_of(p.mode)));
    if (model_.frame == frame::FrameChoice::camera)
      to_.metadata["svnet.poses_deg"] =
          "theta, the azimuth, and phi, the elevation of the camera; (90, 90) is the top view";
  }

  const Model& model_;
  const OnnxOptions& options_;
  OnnxGraph to_{};
};

}  // namespace

OnnxGraph model_onnx(const Model& model, const OnnxOptions& options) { return ModelEmission(model, options).graph(); }

}  // namespace svnet::io
