#include "predict/camera_head.h"

#include <algorithm>

#include "predict/finite_check.h"
#include "view/symmetry.h"

namespace svnet::predict {
namespace {

/// Poses per run of the network: its weights are read once per run, and the activations of a run stay in cache.
constexpr Index kCameraPosesAtOnce = 64;

/// A tensor (rows, columns), the same one if it has that shape.
void ensure_shape(Tensor& tensor, Index rows, Index columns) {
  if (!tensor.defined() || tensor.dim(0) != rows || tensor.dim(1) != columns) tensor = Tensor::empty({rows, columns});
}

}  // namespace

CameraHead::CameraHead(const Model& model, const InferenceOptions& options)
    : CameraHead(model, split_graph(model.head, model.head_parameters, model.head.output()), options) {}

CameraHead::CameraHead(const Model& model, const std::optional<SplitGraph>& split, const InferenceOptions& options)
    : angles_(model.angles),
      symmetries_(model.symmetries),
      dimension_(element_count(model.head.node(model.head.inputs().at(0)).shape)),
      each_(split ? split->each.graph : model.head, split ? split->each.parameters : model.head_parameters,
            split ? split->each.graph.output() : model.head.output(), options) {
  if (split) once_.emplace(split->once.graph, split->once.parameters, split->once.graph.output(), options);
}

void CameraHead::set_features(std::span<const float> features, ScoreWorkspace& w) const {
  if (w.features.defined() && std::ranges::equal(features, w.features.values<float>())) return;
  Tensor kept = std::move(w.features);  // stays empty if the network throws
  w.repeated_symmetry = -1;
  ensure_shape(kept, symmetries_, dimension_);
  std::ranges::copy(features, kept.data<float>());
  if (once_) {
    ensure_shape(w.picture, symmetries_, once_->output_shape()[0]);
    const float* const input = kept.data<float>();
    once_->run({&input, 1}, symmetries_, w.picture.data<float>(), w.arena(w.once));
  } else {
    w.picture = kept;
  }
  w.features = std::move(kept);
}

void CameraHead::scores(std::span<const float> features, std::span<const view::CameraPose> poses,
                        std::span<float> scores, ScoreWorkspace& w) const {
  if (poses.empty()) return;
  set_features(features, w);
  const Index count = static_cast<Index>(poses.size()), angles = angle_count(angles_), units = w.picture.dim(1);
  const Index rows = std::min(kCameraPosesAtOnce, count);
  if (!w.repeated.defined() || w.repeated.dim(0) < rows) {
    w.repeated = Tensor::empty({rows, units});
    w.inputs = Tensor::empty({rows, angles});
    w.outputs = Tensor::empty({rows, 1});
    w.repeated_symmetry = -1;
  }
  std::ranges::fill(scores, 0.0f);
  for (int symmetry = 0; symmetry < symmetries_; ++symmetry) {
    if (w.repeated_symmetry != symmetry)
      for (Index i = 0; i < w.repeated.dim(0); ++i)
        std::copy_n(w.picture.data<float>() + symmetry * units, units, w.repeated.data<float>() + i * units);
    w.repeated_symmetry = symmetry;
    for (Index begin = 0; begin < count; begin += rows) {
      const Index size = std::min(rows, count - begin);
      for (Index i = 0; i < size; ++i) {
        const view::CameraPose pose = clamped_pose(poses[static_cast<std::size_t>(begin + i)]);
        // Within [0, 360): a model with plain angles was trained on these only.
        const double theta_deg = view::symmetric_theta_deg(symmetry, pose.theta_deg);
        encode_angles(angles_, theta_deg, pose.phi_deg, w.inputs.data<float>() + i * angles);
      }
      const float* const inputs[] = {w.repeated.data<float>(), w.inputs.data<float>()};
      each_.run(inputs, size, w.outputs.data<float>(), w.arena(w.each));
      const auto values = w.outputs.values<float>().first(static_cast<std::size_t>(size));
      check_finite(values, "score", static_cast<std::size_t>(begin));
      for (std::size_t i = 0; i < values.size(); ++i)
        scores[static_cast<std::size_t>(begin) + i] += values[i] / static_cast<float>(symmetries_);
    }
  }
}

}  // namespace svnet::predict
