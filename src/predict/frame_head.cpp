#include "predict/frame_head.h"

#include <algorithm>

#include "predict/finite_check.h"

namespace svnet::predict {
namespace {

constexpr Index kFramePosesAtOnce = 64;

}  // namespace

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
  const Index count = static_cast<Index>(poses.size());
  if (count == 0) return;
  const frame::FrameInputs of_pose(spec_, features, familiarity(features, w).trust);
  const Index rows = std::min(kFramePosesAtOnce, count);
  if (!w.inputs.defined() || w.inputs.dim(0) < rows) w.inputs = Tensor::empty({rows, input_count_});
  w.numbers.resize(static_cast<std::size_t>(input_count_));
  for (Index begin = 0; begin < count; begin += rows) {
    const Index size = std::min(rows, count - begin);
    for (Index i = 0; i < size; ++i) {
      of_pose.write(poses[static_cast<std::size_t>(begin + i)], w.numbers);
      std::ranges::transform(w.numbers, w.inputs.data<float>() + i * input_count_,
                             [](double value) { return static_cast<float>(value); });
    }
    const float* const input = w.inputs.data<float>();
    const auto values = scores.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(size));
    network_.run({&input, 1}, size, values.data(), w.arena(w.rest));
    check_finite(values, "score", static_cast<std::size_t>(begin));
  }
}

}  // namespace svnet::predict
