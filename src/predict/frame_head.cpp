#include "predict/frame_head.h"

#include "predict/input_rows.h"

namespace svnet::predict {

FrameHead::FrameHead(const Model& model, const InferenceOptions& options)
    : spec_(frame_spec(model)),
      input_count_(frame::input_count(spec_)),
      seen_(model.seen),
      network_(model.head, model.head_parameters, model.head.output(), options) {}

Familiarity FrameHead::familiarity(std::span<const float> features, ScoreWorkspace& w) const {
  w.numbers.resize(static_cast<std::size_t>(frame::shape_number_count(spec_)));
  frame::shape_numbers(spec_, features, w.numbers);
  return {frame::distance(seen_, w.numbers), seen_.limit, frame::trust(seen_, w.numbers)};
}

void FrameHead::scores(std::span<const float> features, std::span<const view::CameraPose> poses,
                       std::span<float> scores, ScoreWorkspace& w) const {
  const frame::FrameInputs inputs(spec_, features, familiarity(features, w).trust);
  scores_of_rows(network_, input_count_, inputs, poses, scores, w);
}

}  // namespace svnet::predict
