#pragma once
#include <algorithm>
#include <span>

#include "nn/runtime/inference.h"
#include "predict/finite_check.h"
#include "predict/score_workspace.h"
#include "view/camera_pose.h"

namespace svnet::predict {

/// Runs `network` on a row of `columns` inputs for each pose, which inputs.write(pose, row) computes, some poses at a
/// time. Writes one score per pose. Throws Error for a score that is not finite, and as `inputs` does.
template <class Inputs>
void scores_of_rows(const Inference& network, Index columns, const Inputs& inputs,
                    std::span<const view::CameraPose> poses, std::span<float> scores, ScoreWorkspace& w) {
  constexpr Index kAtOnce = 64;
  const Index count = static_cast<Index>(poses.size());
  if (count == 0) return;
  const Index rows = std::min(kAtOnce, count);
  if (!w.inputs.defined() || w.inputs.dim(0) < rows || w.inputs.dim(1) != columns)
    w.inputs = Tensor::empty({rows, columns});
  w.numbers.resize(static_cast<std::size_t>(columns));
  for (Index begin = 0; begin < count; begin += rows) {
    const Index size = std::min(rows, count - begin);
    for (Index i = 0; i < size; ++i) {
      inputs.write(poses[static_cast<std::size_t>(begin + i)], std::span<double>(w.numbers));
      std::ranges::transform(w.numbers, w.inputs.data<float>() + i * columns,
                             [](double value) { return static_cast<float>(value); });
    }
    const float* const input = w.inputs.data<float>();
    const auto values = scores.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(size));
    network.run({&input, 1}, size, values.data(), w.arena(w.rest));
    check_finite(values, "score", static_cast<std::size_t>(begin));
  }
}

}  // namespace svnet::predict
