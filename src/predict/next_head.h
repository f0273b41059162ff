#pragma once
#include <span>
#include <vector>

#include "data/model.h"
#include "frame/next_inputs.h"
#include "nn/runtime/inference.h"
#include "predict/score_workspace.h"

namespace svnet::predict {

/// The head that ranks camera poses for the next view, on the inputs of frame/next_inputs.h. Thread-safe.
class NextHead {
 public:
  /// Requires a model that has one.
  NextHead(const Model& model, const InferenceOptions& options);

  /// Writes one score per pose, in [0, 1]: about 1/2 plus the semantic score of the candidate's features averaged with
  /// those of a taken view, minus the mean of such scores. A score does not depend on the other poses. `trust`: see
  /// frame/seen_shapes.h. Throws Error as NextInputs does, and for a score that is not finite.
  void scores(std::span<const float> features, double trust, std::span<const frame::TakenView> taken,
              std::span<const view::CameraPose> poses, std::span<float> scores, ScoreWorkspace& workspace) const;

 private:
  frame::FrameSpec spec_;
  Inference network_;
};

}  // namespace svnet::predict
