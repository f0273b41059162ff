#include "io/models/model_file.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "frame/frame_inputs.h"
#include "frame/next_inputs.h"
#include "io/models/graph_json.h"
#include "io/models/model_origin.h"
#include "io/tensors/tensor_file.h"
#include "view/symmetry.h"

namespace svnet::io {
using frame::FrameChoice;
using models::Preprocessing;

namespace {

using nlohmann::json;

json preprocessing_to_json(const Preprocessing& p) {
  return {{"pixels", name_of(p.mode)},
          {"height", p.height},
          {"width", p.width},
          {"interpolation", name_of(p.interpolation)},
          {"channels", "RGB"}};
}

Preprocessing preprocessing_from_json(const json& from) {
  const Preprocessing p{.mode = models::pixel_mode_named(from.at("pixels").get<std::string>()),
                        .height = from.at("height").get<Index>(),
                        .width = from.at("width").get<Index>(),
                        .interpolation = interpolation_named(from.at("interpolation").get<std::string>())};
  check(from.at("channels") == "RGB", "channels are ", from.at("channels").dump(), ", expected RGB");
  check(p.height > 0 && p.width > 0 && p.height <= 8192 && p.width <= 8192, "input size ", p.height, "x", p.width,
        " is out of range");
  return p;
}

void add_parameters(TensorFile& file, const std::string& prefix, const Graph& graph, const Parameters& parameters,
                    StoredPrecision precision) {
  for (const auto& node : graph.nodes())
    for (const auto& spec : node.parameters) {
      const std::string name = node.parameter_name(spec);
      file.add(joined(prefix, "/", name), parameters.at(name),
               is_rounded(name, spec.shape) ? precision : StoredPrecision::f32);
    }
}

/// Which layers have ranges, and of how many channels; the ranges are tensors "ranges/<layer>/low", "…/high", "…/mean".
json ranges_to_json(const ActivationRanges& ranges) {
  json to = json::array();
  for (const auto& [layer, of_layer] : ranges) to.push_back({{"layer", layer}, {"channels", of_layer.low.size()}});
  return to;
}

void add_ranges(TensorFile& file, const ActivationRanges& ranges) {
  const auto add = [&](const std::string& name, const std::vector<float>& values) {
    Tensor tensor = Tensor::empty({static_cast<Index>(values.size())});
    std::ranges::copy(values, tensor.data<float>());
    file.add(name, tensor);
  };
  for (const auto& [layer, of_layer] : ranges) {
    const std::string prefix = "ranges/" + layer + "/";
    add(prefix + "low", of_layer.low);
    add(prefix + "high", of_layer.high);
    add(prefix + "mean", of_layer.mean);
  }
}

ActivationRanges ranges_of(const TensorFile& file, const json& described) {
  ActivationRanges ranges;
  for (const json& item : described) {
    const auto layer = item.at("layer").get<std::string>();
    const auto channels = item.at("channels").get<Index>();
    check(channels > 0, "ranges: layer '", layer, "' has ", channels, " channels");
    const auto values = [&](const char* which) {
      const auto from = file.at("ranges/" + layer + "/" + which, {channels}).values<float>();
      return std::vector<float>(from.begin(), from.end());
    };
    ranges[layer] = {values("low"), values("high"), values("mean")};
  }
  return ranges;
}

void check_backbone(const Model& model) {
  const Preprocessing& p = model.preprocessing;
  const auto images = model.backbone_graph.inputs();
  check(images.size() == 1 && model.backbone_graph.node(images[0]).shape == Shape{p.height, p.width, 3},
        "the backbone does not take images of ", p.height, "x", p.width, ", as preprocessing makes them");
  const NodeId output = model.backbone_graph.find(model.backbone_output);
  check(model.backbone_graph.ancestors({output})[static_cast<std::size_t>(images[0])],
        "the backbone's output does not depend on the image");
}

/// An input that the score does not depend on has no place in the compiled graph.
void check_all_inputs_count(const Graph& head) {
  const std::vector<bool> counts = head.ancestors({head.output()});
  for (const NodeId input : head.inputs())
    check(counts[static_cast<std::size_t>(input)], "the score of the head does not depend on its input '",
          head.node(input).name, "'");
}

void check_square(const Preprocessing& p) {
  check(p.height == p.width, "images of ", p.height, "x", p.width, " cannot be turned; only square ones can");
}

void check_camera_model(const Model& model) {
  check(model.symmetries == 1 || model.symmetries == view::kSymmetries, "there are ", model.symmetries,
        " orientations, expected 1 or ", view::kSymmetries);
  if (model.symmetries != 1) check_square(model.preprocessing);
  check_backbone(model);
  const Graph &backbone = model.backbone_graph, &head = model.head;
  const auto inputs = head.inputs();
  const Shape& features = backbone.node(backbone.find(model.backbone_output)).shape;
  check(inputs.size() == 2 && head.node(inputs[0]).shape == Shape{element_count(features)} &&
            head.node(inputs[1]).shape == Shape{angle_count(model.angles)} &&
            head.node(head.output()).shape == Shape{1},
        "the head does not take the backbone's ", element_count(features),
        " features and the angles, or gives more than one score");
  check_all_inputs_count(head);
}

void check_gain(const GainCalibration& gain) {
  check(gain.residuals.empty() || (gain.residuals.size() >= 2 && std::ranges::is_sorted(gain.residuals)),
        "frame: the residuals in gain are not ascending quantiles");
}

void check_seen(const Model& model) {
  const frame::SeenShapes& seen = model.seen;
  if (seen.mean.empty() && seen.deviation.empty()) return;
  const auto count = static_cast<std::size_t>(frame::shape_number_count(frame_spec(model)));
  check(seen.mean.size() == count && seen.deviation.size() == count, "frame: seen has ", seen.mean.size(),
        " means and ", seen.deviation.size(), " deviations, expected ", count);
  const auto is_size = [](double value) { return std::isfinite(value) && value >= 0; };
  check(std::ranges::all_of(seen.deviation, is_size) && is_size(seen.limit),
        "frame: a deviation or the limit in seen is negative");
}

void check_next_head(const Model& model) {
  const Graph& head = model.next_head;
  if (head.nodes().empty()) return;
  const Index inputs = frame::next_input_count(frame_spec(model));
  check(head.inputs().size() == 1 && head.node(head.inputs()[0]).shape == Shape{inputs} &&
            head.node(head.output()).shape == Shape{1},
        "the head of the next view does not take the ", inputs,
        " inputs of a camera pose and a taken view, or gives more than one score");
}

/// A model in a frame other than `camera`.
void check_frame_model(const Model& model) {
  check(model.depth == frame::DepthChoice::none || frame::has_axis(model.frame), "frame: the frame ",
        name_of(model.frame), " has no depth, expected none, got ", name_of(model.depth));
  if (frame::has_turns(model.frame)) {
    check_square(model.preprocessing);
    check_backbone(model);
  }
  const Graph& head = model.head;
  const Index inputs = frame::input_count(frame_spec(model));
  check(head.inputs().size() == 1 && head.node(head.inputs()[0]).shape == Shape{inputs} &&
            head.node(head.output()).shape == Shape{1},
        "the head does not take the ", inputs, " inputs of a camera pose, or gives more than one score");
  check_all_inputs_count(head);
  check_seen(model);
  check_gain(model.gain);
  check_next_head(model);
}

json frame_to_json(const Model& model) {
  json to = {{"kind", name_of(model.frame)}, {"depth", name_of(model.depth)}};
  const frame::SeenShapes& seen = model.seen;
  if (const GainCalibration& gain = model.gain; !gain.residuals.empty())
    to["gain"] = {{"intercept", gain.intercept}, {"slope", gain.slope}, {"residuals", gain.residuals}};
  if (!seen.mean.empty()) to["seen"] = {{"mean", seen.mean}, {"deviation", seen.deviation}, {"limit", seen.limit}};
  return to;
}

/// Models of earlier versions do not say what they have seen.
frame::SeenShapes seen_from_json(const json& frame) {
  if (!frame.contains("seen")) return {};
  const json& seen = frame.at("seen");
  return {seen.at("mean").get<std::vector<double>>(), seen.at("deviation").get<std::vector<double>>(),
          seen.at("limit").get<double>()};
}

GainCalibration gain_from_json(const json& frame) {
  if (!frame.contains("gain")) return {};
  const json& gain = frame.at("gain");
  return {gain.at("intercept").get<double>(), gain.at("slope").get<double>(),
          gain.at("residuals").get<std::vector<double>>()};
}

/// The description of what the head sees.
json input_to_json(const Model& model, const Graph& backbone) {
  json input;
  if (frame::has_backbone(model.frame)) {
    input["backbone"] = {
        {"name", model.backbone}, {"output", model.backbone_output}, {"graph", graph_to_json(backbone)}};
    if (model.backbone_ranges) input["backbone"]["ranges"] = ranges_to_json(*model.backbone_ranges);
    input["preprocessing"] = preprocessing_to_json(model.preprocessing);
  }
  if (model.frame == FrameChoice::camera)
    input["angles"] = {
        {"encoding", name_of(model.angles)}, {"unit", "degree"}, {"order", json::array({"theta", "phi"})}};
  else
    input["frame"] = frame_to_json(model);
  return input;
}

template <class Enum>
Enum choice_from_json(const json& from, const char* key) {
  const auto name = from.at(key).get<std::string>();
  const auto found = find_enum<Enum>(name);
  check(found.has_value(), "frame: ", key, " is '", name, "', which this version does not know");
  return *found;
}

}  // namespace

void write_model(const std::filesystem::path& path, const Model& model) {
  const Graph backbone = frame::has_backbone(model.frame)
                             ? model.backbone_graph.up_to(model.backbone_graph.find(model.backbone_output))
                             : Graph();
  TensorFile file;
  file.description() = input_to_json(model, backbone);
  file.description()["kind"] = "model";
  file.description()["head"] = {{"graph", graph_to_json(model.head)}};
  file.description()["input_fingerprint"] = model.input_fingerprint;
  if (model.symmetries != 1) file.description()["head"]["orientations"] = model.symmetries;
  if (model.precision != StoredPrecision::f32) file.description()["precision"] = name_of(model.precision);
  const bool has_next = !model.next_head.nodes().empty();
  if (has_next) file.description()["next"] = {{"graph", graph_to_json(model.next_head)}};
  write_origin(model, file.description());
  add_parameters(file, "backbone", backbone, model.backbone_parameters, model.precision);
  if (model.backbone_ranges) add_ranges(file, *model.backbone_ranges);
  add_parameters(file, "head", model.head, model.head_parameters, model.precision);
  if (has_next) add_parameters(file, "next", model.next_head, model.next_parameters, model.precision);
  file.write(path);
}

namespace {

/// Calls `read`, whose errors get the name of the file.
template <class Read>
void reading(const TensorFile& file, const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    fail(file.path(), ": ", error.what());
  } catch (const json::exception& error) {
    fail(file.path(), ": ", error.what());
  }
}

Model model_of(const TensorFile& file) {
  Model model;
  model.input_fingerprint = file.get<std::string>("input_fingerprint");
  if (file.description().contains("frame")) {
    const json frame = file.get<json>("frame");
    reading(file, [&] {
      model.frame = choice_from_json<FrameChoice>(frame, "kind");
      model.depth = choice_from_json<frame::DepthChoice>(frame, "depth");
      model.seen = seen_from_json(frame);
      model.gain = gain_from_json(frame);
    });
  }
  reading(file, [&] {
    read_origin(file.description(), model);
    if (file.description().contains("precision"))
      model.precision =
          enum_from_name<StoredPrecision>("precision", file.description().at("precision").get<std::string>());
  });
  const bool is_camera = model.frame == FrameChoice::camera, has_backbone = frame::has_backbone(model.frame);
  const json head = file.get<json>("head"), backbone = has_backbone ? file.get<json>("backbone") : json(),
             preprocessing = has_backbone ? file.get<json>("preprocessing") : json(),
             angles = is_camera ? file.get<json>("angles") : json();
  reading(file, [&] {
    model.head = graph_from_json(head.at("graph"), "head");
    if (has_backbone) {
      model.backbone = backbone.at("name").get<std::string>();
      model.backbone_output = backbone.at("output").get<std::string>();
      model.backbone_graph = graph_from_json(backbone.at("graph"), "backbone");
      model.preprocessing = preprocessing_from_json(preprocessing);
      if (backbone.contains("ranges"))
        model.backbone_ranges = std::make_shared<ActivationRanges>(ranges_of(file, backbone.at("ranges")));
    }
    if (is_camera) {
      model.angles = models::angle_encoding_named(angles.at("encoding").get<std::string>());
      model.symmetries = head.value("orientations", 1);
      check_camera_model(model);
    } else {
      if (file.description().contains("next"))
        model.next_head = graph_from_json(file.description().at("next").at("graph"), "next");
      check_frame_model(model);
    }
  });
  model.backbone_parameters = file.parameters("backbone", model.backbone_graph);
  model.head_parameters = file.parameters("head", model.head);
  if (!model.next_head.nodes().empty()) model.next_parameters = file.parameters("next", model.next_head);
  return model;
}

}  // namespace

Model read_model(const std::filesystem::path& path) { return model_of(TensorFile::read(path, "model")); }

std::string read_model_fingerprint(const std::filesystem::path& path) {
  return TensorFile::read_description(path, "model").get<std::string>("input_fingerprint");
}

Model parse_model(const std::string& name, std::span<const std::byte> contents) {
  return model_of(TensorFile::parse(name, contents, "model"));
}

}  // namespace svnet::io
