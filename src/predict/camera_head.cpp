#include "predict/camera_head.h"

#include <algorithm>

#include "predict/finite_check.h"
#include "view/symmetry.h"

namespace svnet::predict {
namespace {

/// Poses per run of the network: its weights are read once per run, and the activations of a run stay in cache.
constexpr Index kCameraPosesAtOnce = 256;

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
      rest_(split ? split->rest.graph : model.head, split ? split->rest.parameters : model.head_parameters,
            split ? split->rest.graph.output() : model.head.output(), options) {
  if (!split) return;
  once_.emplace(split->once.graph, split->once.parameters, split->once.graph.output(), options);
  layers_.emplace(*split, angles_, options);
}

void CameraHead::set_features(std::span<const float> features, ScoreWorkspace& w) const {
  if (w.features.defined() && std::ranges::equal(features, w.features.values<float>())) return;
  Tensor kept = std::move(w.features);  // stays empty if the network throws
  ensure_shape(kept, symmetries_, dimension_);
  std::ranges::copy(features, kept.data<float>());
  if (layers_) {
    ensure_shape(w.units, symmetries_, layers_->units());
    const float* const input = kept.data<float>();
    once_->run({&input, 1}, symmetries_, w.units.data<float>(), w.arena(w.once));
    w.pictures.resize(static_cast<std::size_t>(symmetries_));
    for (Index i = 0; i < symmetries_; ++i)
      layers_->set_picture(w.units.data<float>() + i * layers_->units(), w.pictures[static_cast<std::size_t>(i)]);
  }
  w.features = std::move(kept);
}

void CameraHead::run(int symmetry, Index count, ScoreWorkspace& w) const {
  const float* inputs[] = {nullptr, w.inputs.data<float>()};
  if (layers_) {
    layers_->run(w.pictures[static_cast<std::size_t>(symmetry)], count, w.inputs.data<float>(), w.hidden.data<float>(),
                 w.pose_buffers);
    inputs[0] = w.hidden.data<float>();
  } else {
    const float* const features = w.features.data<float>() + symmetry * dimension_;
    for (Index i = 0; i < count; ++i) std::copy_n(features, dimension_, w.repeated.data<float>() + i * dimension_);
    inputs[0] = w.repeated.data<float>();
  }
  rest_.run({inputs, layers_ ? std::size_t{1} : std::size_t{2}}, count, w.outputs.data<float>(), w.arena(w.rest));
}

void CameraHead::reserve(Index rows, ScoreWorkspace& w) const {
  if (w.inputs.defined() && w.inputs.dim(0) >= rows) return;
  w.inputs = Tensor::empty({rows, angle_count(angles_)});
  w.outputs = Tensor::empty({rows, 1});
  if (layers_) {
    w.hidden = Tensor::empty({rows, layers_->outputs()});
  } else {
    w.repeated = Tensor::empty({rows, dimension_});
  }
}

void CameraHead::scores(std::span<const float> features, std::span<const view::CameraPose> poses,
                        std::span<float> scores, ScoreWorkspace& w) const {
  if (poses.empty()) return;
  set_features(features, w);
  const Index count = static_cast<Index>(poses.size()), rows = std::min(kCameraPosesAtOnce, count);
  reserve(rows, w);
  std::ranges::fill(scores, 0.0f);
  for (int symmetry = 0; symmetry < symmetries_; ++symmetry)
    for (Index begin = 0; begin < count; begin += rows) {
      const Index size = std::min(rows, count - begin);
      for (Index i = 0; i < size; ++i) {
        const view::CameraPose pose = clamped_pose(poses[static_cast<std::size_t>(begin + i)]);
        // Within [0, 360): a model with plain angles was trained on these only.
        const double theta_deg = view::symmetric_theta_deg(symmetry, pose.theta_deg);
        encode_angles(angles_, theta_deg, pose.phi_deg, w.inputs.data<float>() + i * angle_count(angles_));
      }
      run(symmetry, size, w);
      const auto values = w.outputs.values<float>().first(static_cast<std::size_t>(size));
      check_finite(values, "score", static_cast<std::size_t>(begin));
      for (std::size_t i = 0; i < values.size(); ++i)
        scores[static_cast<std::size_t>(begin) + i] += values[i] / static_cast<float>(symmetries_);
    }
}

}  // namespace svnet::predict
