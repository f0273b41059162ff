#include <nlohmann/json.hpp>

#include "base/error.h"
#include "exports/exports.h"
#include "io/files/atomic_file.h"
#include "io/files/fresh_folder.h"
#include "io/keras/keras_model_folder.h"
#include "models/preprocessing_layer.h"
#include "models/sv_net.h"
#include "nn/runtime/inference.h"

namespace svnet::exports {
namespace {

using models::AngleEncoding;
using models::GraphWithParameters;

GraphWithParameters network_of(const Model& model, const KerasExport& options) {
  if (options.part == ModelPart::head) return {model.head, model.head_parameters};
  if (options.part == ModelPart::next) return {model.next_head, model.next_parameters};
  GraphWithParameters backbone{model.backbone_graph.up_to(model.backbone_graph.find(model.backbone_output)),
                               model.backbone_parameters};
  if (options.preprocessing)
    backbone = models::with_preprocessing(model.preprocessing.mode, backbone.graph, backbone.parameters);
  if (options.part == ModelPart::backbone) return backbone;
  GraphWithParameters whole{models::joined_graph(backbone.graph, model.head), std::move(backbone.parameters)};
  for (const auto& [name, value] : model.head_parameters.items()) whole.parameters.set(name, value);
  return whole;
}

const char* formula_of(AngleEncoding encoding) {
  switch (encoding) {
    case AngleEncoding::radians:
      return "[theta - np.pi, phi - np.pi]";
    case AngleEncoding::sphere:
      return "[np.cos(phi) * np.cos(theta), np.cos(phi) * np.sin(theta), np.sin(phi)]";
    case AngleEncoding::harmonics:
      return "[4 * 2**0.5 * np.cos(phi) * f(k * theta) for k in (1, 2) for f in (np.cos, np.sin)] + "
             "[4 * (np.degrees(phi) - 65) / 15]";
  }
  return "";
}

std::string angles_text(AngleEncoding encoding) {
  return joined(
      "import numpy as np\n\n\ndef angles(poses_deg):\n"
      "    \"\"\"The input `angles` of the model: (M, 2) theta and phi in degrees -> (M, ",
      angle_count(encoding),
      ") float32.\"\"\"\n    poses = np.asarray(poses_deg, np.float64)\n"
      "    theta, phi = np.radians(poses[:, 0] % 360), np.radians(poses[:, 1])\n    return np.stack(",
      formula_of(encoding), ", axis=1).astype(np.float32)\n");
}

/// As many copies of a row as there are poses.
Tensor repeated(const float* row, Index size, Shape shape, Index count) {
  shape.insert(shape.begin(), count);
  Tensor rows = Tensor::empty(std::move(shape));
  for (Index i = 0; i < count; ++i) std::copy_n(row, size, rows.data<float>() + i * size);
  return rows;
}

/// What the exported network takes of a sample, in the order of its inputs.
std::vector<Tensor> inputs_of(const Model& model, const KerasExport& options, const Sample& sample) {
  if (sample.pose_inputs.defined()) return {sample.pose_inputs};
  const auto count = static_cast<Index>(sample.poses.size());
  Tensor picture;
  if (options.part != ModelPart::head) picture = network_picture(model, sample.picture, options.preprocessing);
  if (options.part == ModelPart::backbone) return {picture};
  const Index angles = angle_count(model.angles);
  Tensor encoded = Tensor::empty({count, angles});
  for (Index i = 0; i < count; ++i) {
    const view::CameraPose& pose = sample.poses[static_cast<std::size_t>(i)];
    models::encode_angles(model.angles, pose.theta_deg, pose.phi_deg, encoded.data<float>() + i * angles);
  }
  const Tensor& first = options.part == ModelPart::all ? picture : sample.features;
  Shape shape(first.shape().begin() + 1, first.shape().end());
  return {repeated(first.data<float>(), first.size(), std::move(shape), count), encoded};
}

}  // namespace

Agreement export_keras(const Model& model, const std::filesystem::path& folder, const KerasExport& options) {
  check_part(model, options.part);
  check(options.part != ModelPart::all || model.symmetries == 1,
        "[keras] the model averages over the orientations of the image, which a Keras model cannot say in layers; "
        "export its networks with --part backbone and --part head, or the whole to ONNX");
  const GraphWithParameters network = network_of(model, options);
  io::FreshFolder fresh(folder);
  io::write_keras_model(fresh.path(), network.graph, network.parameters);
  const bool takes_angles = options.part != ModelPart::backbone && options.part != ModelPart::next &&
                            model.frame == frame::FrameChoice::camera;
  if (takes_angles) io::write_atomically(fresh.path() / "angles.py", angles_text(model.angles));
  const io::KerasModel written = io::read_keras_model(fresh.path());
  const Inference inference(written.graph, written.parameters, written.graph.output());
  const auto values = [&](const Sample& sample) {
    const Tensor output = inference.run(inputs_of(model, options, sample));
    return std::vector<float>(output.data<float>(), output.data<float>() + output.size());
  };
  // A head with several orientations is compared on the first. The written backbone multiplies in f32.
  Model compared = model;
  compared.backbone_ranges.reset();
  if (options.part == ModelPart::head) compared.symmetries = 1;
  const Agreement result = agreement(folder.string(), compared, options.part, values, bound_of(StoredPrecision::f32));
  fresh.keep();
  return result;
}

}  // namespace svnet::exports
