#include "predict/score_head.h"

#include <algorithm>

#include "base/error.h"
#include "predict/finite_check.h"
#include "view/symmetry.h"

namespace svnet::predict {
using view::CameraPose;

namespace {

/// Poses per run of the head: many, so that its weights are read rarely, but few enough that the repeated features stay
/// small.
constexpr Index kPosesAtOnce = 32;

/// The number of features that the head of a model takes.
Index feature_count_of(const Model& model) {
  return model.frame == frame::FrameChoice::camera
             ? model.symmetries * element_count(model.head.node(model.head.inputs().at(0)).shape)
             : frame::feature_count(frame_spec(model));
}

}  // namespace

ScoreHead::ScoreHead(const Model& model, const InferenceOptions& options)
    : spec_(frame_spec(model)),
      seen_(model.seen),
      angles_(model.angles),
      symmetries_(model.symmetries),
      feature_count_(feature_count_of(model)),
      network_(model.head, model.head_parameters, model.head.output(), options) {}

void ScoreHead::check_features(const Tensor& features) const {
  check(features.defined() && features.shape() == Shape{1, feature_count_} && features.dtype() == DType::f32,
        "[predict] features are ", features.defined() ? to_string(features.shape()) : "none", ", the model expects ",
        to_string({1, feature_count_}), " f32");
  check_finite(features, "feature");
}

ScoreHead::Familiarity ScoreHead::familiarity(const Tensor& features) const {
  check_features(features);
  if (spec_.frame == frame::FrameChoice::camera) return {};
  const std::vector<double> numbers = frame::shape_numbers(spec_, features.values<float>());
  return {frame::distance(seen_, numbers), seen_.limit, frame::trust(seen_, numbers)};
}

std::vector<float> ScoreHead::scores(const Tensor& features, std::span<const CameraPose> poses) const {
  check_features(features);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::string problem = pose_problem(poses[i]);
    check(problem.empty(), "[predict] pose ", i, ": ", problem);
  }
  return spec_.frame == frame::FrameChoice::camera ? camera_scores(features, poses) : frame_scores(features, poses);
}

std::vector<float> ScoreHead::frame_scores(const Tensor& features, std::span<const CameraPose> poses) const {
  const double trust = familiarity(features).trust;
  const Index inputs = frame::input_count(spec_), count = static_cast<Index>(poses.size());
  std::vector<float> result;
  for (Index begin = 0; begin < count; begin += kPosesAtOnce) {
    const Index size = std::min(kPosesAtOnce, count - begin);
    Tensor batch = Tensor::empty({size, inputs});
    for (Index i = 0; i < size; ++i) {
      const auto values =
          frame::frame_inputs(spec_, features.values<float>(), poses[static_cast<std::size_t>(begin + i)], trust);
      std::transform(values.begin(), values.end(), batch.data<float>() + i * inputs,
                     [](double value) { return static_cast<float>(value); });
    }
    const Tensor values = network_.run({batch});
    check_finite(values, "score", static_cast<std::size_t>(begin));
    result.insert(result.end(), values.data<float>(), values.data<float>() + size);
  }
  return result;
}

std::vector<float> ScoreHead::camera_scores(const Tensor& features, std::span<const CameraPose> poses) const {
  const Index count = static_cast<Index>(poses.size()), angles = angle_count(angles_);
  const Index dimension = feature_count_ / symmetries_;
  std::vector<float> result(poses.size(), 0.0f);
  for (int symmetry = 0; symmetry < symmetries_; ++symmetry)
    for (Index begin = 0; begin < count; begin += kPosesAtOnce) {
      const Index size = std::min(kPosesAtOnce, count - begin);
      Tensor repeated = Tensor::empty({size, dimension}), encoded = Tensor::empty({size, angles});
      for (Index i = 0; i < size; ++i) {
        const CameraPose pose = clamped_pose(poses[static_cast<std::size_t>(begin + i)]);
        // Within [0, 360): a model with plain angles was trained on these only.
        const double theta_deg = view::symmetric_theta_deg(symmetry, pose.theta_deg);
        std::copy_n(features.data<float>() + symmetry * dimension, dimension, repeated.data<float>() + i * dimension);
        encode_angles(angles_, theta_deg, pose.phi_deg, encoded.data<float>() + i * angles);
      }
      const Tensor values = network_.run({repeated, encoded});
      check_finite(values, "score", static_cast<std::size_t>(begin));
      for (Index i = 0; i < size; ++i)
        result[static_cast<std::size_t>(begin + i)] += values.data<float>()[i] / static_cast<float>(symmetries_);
    }
  return result;
}

}  // namespace svnet::predict
