#pragma once
#include <memory>
#include <string>
#include <vector>

#include "frame/frame_inputs.h"
#include "frame/seen_shapes.h"
#include "models/preprocessing.h"
#include "models/sv_net.h"
#include "nn/graph/parameters.h"
#include "nn/graph/stored_precision.h"
#include "nn/runtime/inference_options.h"

namespace svnet {

/// What a model was trained on. No categories: not known, the model was made by an earlier version.
struct TrainedOn {
  std::vector<std::string> categories{};
  Index objects = 0, top_views = 0;
};

/// What a model reached on categories that it was not trained on. No values: not known, or none were held out.
struct HeldOutResults {
  std::vector<std::string> categories{};
  Index problems = 0;
  /// A cell of a table of evaluation.json: how well the views that `selector` chose were clustered by `pipeline`.
  struct Value {
    std::string pipeline, selector, metric;
    double mean = 0, standard_error = 0;  ///< NaN if not known
  };
  std::vector<Value> values{};
};

/// What moving the camera from above to the best pose gained on categories that were left out of the fit, as semantic
/// score: gain = intercept + slope · margin + residual, where the margin is the difference of the predicted centred
/// scores. No residuals: not known.
struct GainCalibration {
  double intercept = 0, slope = 0;
  std::vector<double> residuals{};  ///< quantiles at 0, 1/n, …, 1, ascending
};

/// A trained SV-net: it scores camera poses for a top image.
struct Model {
  frame::FrameChoice frame = frame::FrameChoice::camera;
  /// Of the frames `axis` and `turned_axis` only.
  frame::DepthChoice depth = frame::DepthChoice::none;
  /// Of the frames other than `camera`: what top views the head was fitted to.
  frame::SeenShapes seen{};
  /// Of the frames other than `camera`.
  GainCalibration gain{};
  // The backbone, of all frames but `axis`. In frames with turns its output are the values of one turn: it ends in the
  // layers of models/turned_backbone.h.
  std::string backbone;                 // "mobilenet"
  std::string backbone_output;          // the layer whose flattened output is the head's input
  models::Preprocessing preprocessing;  // of the top image
  Graph backbone_graph;
  Parameters backbone_parameters;
  /// Not null: the backbone multiplies in int8, for activations within these ranges, as it did when the head was made.
  std::shared_ptr<const ActivationRanges> backbone_ranges{};
  models::AngleEncoding angles = models::AngleEncoding::radians;  // of the frame `camera` only
  /// Of the frame `camera` only. A score is the mean over these symmetries of the top image (view/symmetry.h). 1: as
  /// taken; kSymmetries: all, and the preprocessed image must be square.
  int symmetries = 1;
  Graph head;  // as sv_net() or, in frames other than `camera`, as models/pose_head.h makes it
  Parameters head_parameters;
  /// Of the frames other than `camera`: ranks the poses of the next view, on the inputs of frame/next_inputs.h, as
  /// models/pose_head.h makes it. No layers: not known.
  Graph next_head{};
  Parameters next_parameters{};
  std::string input_fingerprint;  // of everything that the parameters depend on
  TrainedOn trained_on{};
  HeldOutResults held_out{};
  /// How a file holds the kernels. In int8 their values are products of whole numbers and scales.
  StoredPrecision precision = StoredPrecision::f32;
};

/// `options` for the networks of a model: those of a model stored in int8 keep their dense layers in int8, and a
/// backbone with ranges multiplies in int8, with the kernels that were chosen when its features were made. If int8 is
/// asked for and a backbone has no ranges, compiling it throws Error.
inline InferenceOptions inference_options(const Model& model, InferenceOptions options = {}) {
  options.int8_dense = options.int8_dense || model.precision == StoredPrecision::int8;
  if (model.backbone_ranges) {
    options.precision = kernels::Precision::int8;
    options.convolution = kernels::Convolution::automatic;  // decides which products are in int8
    options.ranges = model.backbone_ranges;
  }
  return options;
}

/// What the head of a model in a frame other than `camera` sees.
inline frame::FrameSpec frame_spec(const Model& model) {
  const bool turns = frame::has_turns(model.frame);
  const Graph& backbone = model.backbone_graph;
  return {.frame = model.frame,
          .depth = model.depth,
          .components = turns ? element_count(backbone.node(backbone.find(model.backbone_output)).shape) : 0};
}

}  // namespace svnet
