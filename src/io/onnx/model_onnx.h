#pragma once
#include "data/model.h"
#include "data/model_part.h"
#include "io/onnx/onnx_graph.h"
#include "nn/graph/stored_precision.h"

namespace svnet::io {

struct OnnxOptions {
  ModelPart part = ModelPart::all;
  StoredPrecision precision = StoredPrecision::f32;
  /// The image has RGB values 0 to 255, which the graph preprocesses. Otherwise it is preprocessed
  /// (models/preprocessing.h).
  bool preprocessing = false;
};

/// A model, or a part of it, as an ONNX graph. All tensors are float32:
///   all       image (1, H, W, 3), poses_deg (M, 2) -> scores (M, 1)
///   backbone  image (N, H, W, 3) -> features (N, D)
///   head      frame `camera`: features (F, D), poses_deg (M, 2) -> scores (M, 1), F = 1 or M. Of a model with
///             symmetries the features of all, (1, D), as svnet_embed gives them.
///             other frames: pose (M, I), the inputs of frame/frame_inputs.h -> scores (M, 1)
///   next      pose (M, I), the inputs of frame/next_inputs.h -> scores (M, 1)
/// The image has the size that the model takes. poses_deg are theta and phi in degrees. What depends on the image is
/// computed once for all poses.
///
/// Requires that the model has that part (data/model_part.h). Throws Error for layers that cannot be said in ONNX.
OnnxGraph model_onnx(const Model& model, const OnnxOptions& options);

}  // namespace svnet::io
