#include "base/error.h"
#include "exports/exports.h"
#include "io/files/atomic_file.h"
#include "io/onnx/model_onnx.h"
#include "io/onnx/onnx_reader.h"
#include "io/onnx/onnx_run.h"

namespace svnet::exports {
namespace {

io::OnnxTensor onnx_tensor(const Tensor& from) {
  const auto values = from.values<float>();
  return {from.shape(), {values.begin(), values.end()}};
}

io::OnnxTensor pose_tensor(const std::vector<view::CameraPose>& poses) {
  io::OnnxTensor tensor{{static_cast<Index>(poses.size()), 2}, {}};
  for (const view::CameraPose& pose : poses)
    tensor.values.insert(tensor.values.end(), {static_cast<float>(pose.theta_deg), static_cast<float>(pose.phi_deg)});
  return tensor;
}

}  // namespace

Agreement export_onnx(const Model& model, const std::filesystem::path& path, const OnnxExport& options) {
  check_part(model, options.part);
  std::string bytes;
  {
    const io::OnnxGraph graph = io::model_onnx(
        model, {.part = options.part, .precision = options.precision, .preprocessing = options.preprocessing});
    bytes = io::onnx_bytes(path.string(), graph, options.opset);
  }
  const io::OnnxGraph written = io::parse_onnx(path.string(), bytes);
  const auto values = [&](const Sample& sample) {
    std::map<std::string, io::OnnxTensor> inputs;
    for (const io::OnnxPort& port : written.inputs)
      if (port.name == "image")
        inputs[port.name] = onnx_tensor(network_picture(model, sample.picture, options.preprocessing));
      else if (port.name == "poses_deg")
        inputs[port.name] = pose_tensor(sample.poses);
      else
        inputs[port.name] = onnx_tensor(port.name == "features" ? sample.features : sample.pose_inputs);
    return run_onnx(written, inputs).values;
  };
  Model compared = model;
  compared.backbone_ranges.reset();  // the written backbone multiplies in f32
  const Agreement result = agreement(path.string(), compared, options.part, values, bound_of(options.precision));
  io::write_atomically(path, bytes);
  return result;
}

}  // namespace svnet::exports
