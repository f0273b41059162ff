#include "predict/next_head.h"

#include "predict/input_rows.h"

namespace svnet::predict {

NextHead::NextHead(const Model& model, const InferenceOptions& options)
    : spec_(frame_spec(model)), network_(model.next_head, model.next_parameters, model.next_head.output(), options) {}

void NextHead::scores(std::span<const float> features, double trust, std::span<const frame::TakenView> taken,
                      std::span<const view::CameraPose> poses, std::span<float> scores,
                      ScoreWorkspace& workspace) const {
  const frame::NextInputs inputs(spec_, features, taken, trust);
  scores_of_rows(network_, frame::next_input_count(spec_), inputs, poses, scores, workspace);
}

}  // namespace svnet::predict
