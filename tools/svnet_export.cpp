// svnet-export: a trained model in the formats of others.
#include "command/command.h"
#include "exports/exports.h"
#include "io/files/atomic_file.h"
#include "io/models/model_file.h"
#include "io/onnx/onnx_graph.h"

namespace {

using namespace svnet;
using namespace svnet::command;
namespace fs = std::filesystem;

struct Arguments {
  fs::path model, onnx, keras, safetensors;
  std::string part{name_of(ModelPart::all)}, precision{name_of(StoredPrecision::f32)};
  Index opset = io::kMostOnnxOpset;
  bool preprocessing = false;
};

void check_together(const Arguments& a) {
  if (a.onnx.empty() && a.keras.empty() && a.safetensors.empty())
    wrong_usage("nothing to write; give --onnx, --keras or --safetensors");
  if (!a.keras.empty() && a.precision != name_of(StoredPrecision::f32))
    wrong_usage("--keras takes no --precision: Keras' layers have float32 weights");
  if (!a.safetensors.empty() && (a.part != name_of(ModelPart::all) || a.preprocessing))
    wrong_usage("--safetensors takes neither --part nor --preprocessing: a model file of svnet is always whole");
}

void write_exports(const Arguments& a, Console& console) {
  const auto part = enum_from_name<ModelPart>("--part", a.part);
  const auto precision = enum_from_name<StoredPrecision>("--precision", a.precision);
  for (const fs::path& file : {a.onnx, a.safetensors})
    if (!file.empty()) io::check_can_be_written(file, {a.model});
  const Model model = io::read_model(a.model);
  const auto said = [&](const fs::path& path, const exports::Agreement& agreement, StoredPrecision of) {
    console.result(path.string() + ": agrees with the model on " + agreement.text(exports::bound_of(of)));
  };
  if (!a.onnx.empty())
    said(a.onnx,
         exports::export_onnx(model, a.onnx,
                              {.part = part,
                               .precision = precision,
                               .preprocessing = a.preprocessing,
                               .opset = static_cast<int>(a.opset)}),
         precision);
  if (!a.keras.empty())
    said(a.keras, exports::export_keras(model, a.keras, {.part = part, .preprocessing = a.preprocessing}),
         StoredPrecision::f32);
  if (!a.safetensors.empty())
    said(a.safetensors, exports::export_safetensors(model, a.safetensors, precision), precision);
}

}  // namespace

int main(int argc, char** argv) {
  Command command(
      "svnet-export",
      "Writes a trained model for ONNX Runtime, OpenCV, TensorRT or OpenVINO (--onnx), for Keras 3 (--keras), "
      "or for svnet itself with smaller weights (--safetensors). Each export is read back, run and compared "
      "with the model on generated pictures before it gets its name; if scores differ by more than 1e-5 "
      "(bf16: 5e-3, int8: 2e-2), nothing is written.",
      "svnet-export model.safetensors --onnx model.onnx --preprocessing\n"
      "svnet-export model.safetensors --safetensors small.safetensors --precision int8");
  Arguments a;
  command.add("MODEL", a.model, "A model that svnet-train wrote (model.safetensors)").required();
  command
      .add(
          "--onnx", a.onnx,
          "Writes an ONNX file. Inputs: image (1, height, width, 3), RGB, and poses_deg (M, 2), theta and phi; output: "
          "scores (M, 1). What depends on the image is computed once for all poses")
      .value_name("FILE");
  command
      .add("--keras", a.keras,
           "Writes a folder for keras.saving.load_model: inputs image and angles, which angles.py in the folder makes "
           "of "
           "theta and phi; output: score")
      .value_name("FOLDER");
  command
      .add("--safetensors", a.safetensors,
           "Writes a model file of svnet, with weights of --precision, which all commands and libsvnet read")
      .value_name("FILE");
  command
      .add("--part", a.part,
           "all: from the image to scores; backbone: from the image to features; head: from features to scores; "
           "next: from a pose and the views taken to scores. Models "
           "in other frames than camera have only the parts, those in the frame axis only the head")
      .one_of(names_of<ModelPart>())
      .shows_default();
  command
      .add(
          "--precision", a.precision,
          "How kernels of convolutions and dense layers are stored. int8: with a scale per output channel; activations "
          "are float32 in all of them")
      .one_of(names_of<StoredPrecision>())
      .shows_default();
  command.add_flag("--preprocessing", a.preprocessing,
                   "The image has RGB values 0 to 255, and the network preprocesses it. Otherwise the caller does as "
                   "svnet-info says. It must have the network's size in any case");
  command.add("--opset", a.opset, "The version of ONNX' operations, 13 to 17").value_name("N").shows_default();
  command.add_sandbox();
  return command.run(argc, argv, [&](Console& console) {
    check_together(a);
    write_exports(a, console);
  });
}
