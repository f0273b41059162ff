#pragma once
#include <filesystem>

#include "exports/agreement.h"

// A trained model in the formats of others. Each export is compared with the model (agreement.h) before it appears
// under its name; if it differs by more than bound_of(precision), Error is thrown and nothing is written.
// The backbone of a model that multiplies in int8 is written, to ONNX and Keras, as one that multiplies in f32.
namespace svnet::exports {

struct OnnxExport {
  ModelPart part = ModelPart::all;
  StoredPrecision precision = StoredPrecision::f32;
  bool preprocessing = false;  ///< the graph takes RGB values 0 to 255
  int opset = 17;
};
/// Writes an ONNX file (io/onnx/model_onnx.h).
Agreement export_onnx(const Model& model, const std::filesystem::path& path, const OnnxExport& options);

struct KerasExport {
  ModelPart part = ModelPart::all;
  bool preprocessing = false;
};
/// Writes a folder that keras.saving.load_model reads (io/keras/keras_model_folder.h):
///   all       inputs image (N, H, W, 3) and angles (N, A), output score (N, 1)
///   backbone  input image, output features
///   head      of the frame `camera`: inputs features (N, D) and angles (N, A); of others: input pose (N, I)
///   next      input pose (N, I)
/// and, if it takes angles, angles.py, which makes them of theta and phi. Throws Error for `all` if the model is in
/// another frame, or scores several orientations of the image, and if the folder exists and is not empty.
Agreement export_keras(const Model& model, const std::filesystem::path& folder, const KerasExport& options);

/// Writes a model file of svnet with weights of another precision.
Agreement export_safetensors(const Model& model, const std::filesystem::path& path, StoredPrecision precision);

}  // namespace svnet::exports
