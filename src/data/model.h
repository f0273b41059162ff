#pragma once
#include <string>

#include "frame/frame_choice.h"
#include "models/preprocessing.h"
#include "models/sv_net.h"
#include "nn/graph/parameters.h"

namespace svnet {

/// A trained SV-net: it scores camera poses for a top image.
struct Model {
  frame::FrameChoice frame = frame::FrameChoice::camera;
  /// Of the frame `axis` only.
  frame::DepthChoice depth = frame::DepthChoice::none;
  // The backbone, of the frame `camera` only.
  std::string backbone;                 // "mobilenet"
  std::string backbone_output;          // the layer whose flattened output is the head's input
  models::Preprocessing preprocessing;  // of the top image
  Graph backbone_graph;
  Parameters backbone_parameters;
  models::AngleEncoding angles = models::AngleEncoding::radians;
  /// A score is the mean over these symmetries of the top image (view/symmetry.h). 1: as taken; kSymmetries: all, and
  /// the preprocessed image must be square.
  int symmetries = 1;
  Graph head;  // as sv_net() or, in the frame `axis`, as linear_head() makes it
  Parameters head_parameters;
  std::string input_fingerprint;  // of everything that the parameters depend on
};

}  // namespace svnet
