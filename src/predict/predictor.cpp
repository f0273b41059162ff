#include "predict/predictor.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "models/orientation.h"

namespace svnet {
namespace {

/// Poses that the head sees at once: enough to read its weights seldom, few enough that repeated features stay small.
constexpr Index kPosesAtOnce = 32;

/// `first`: the number of the first value.
void check_finite(const Tensor& values, const char* what, std::size_t first = 0) {
  const auto numbers = values.values<float>();
  for (std::size_t i = 0; i < numbers.size(); ++i)
    check(std::isfinite(numbers[i]), "[predict] ", what, " ", first + i, " is ", numbers[i], ", not a finite number");
}

}  // namespace

Predictor::Predictor(const std::filesystem::path& model_file) : Predictor(read_model(model_file)) {}

Predictor::Predictor(const Model& model)
    : preprocessing_(model.preprocessing),
      angles_(model.angles),
      orientations_(model.orientations),
      backbone_(model.backbone_graph, model.backbone_parameters, model.backbone_graph.find(model.backbone_output)),
      head_(model.head, model.head_parameters, model.head.output()) {
  feature_count_ = orientations_ * element_count(backbone_.output_shape());
}

Tensor Predictor::embed(const Image& top) const {
  check(top.height > 0 && top.width > 0 && static_cast<Index>(top.rgb.size()) == top.height * top.width * 3,
        "[predict] the image says ", top.height, "x", top.width, " pixels and holds ", top.rgb.size(), " bytes");
  Tensor batch = Tensor::empty({orientations_, preprocessing_.height, preprocessing_.width, 3});
  prepare(preprocessing_, top, batch.data<float>());
  for (int orientation = 1; orientation < orientations_; ++orientation)
    orient(orientation, preprocessing_.width, batch.data<float>(),
           batch.data<float>() + orientation * preprocessing_.size());
  const Tensor features = backbone_.run({batch});
  check_finite(features, "feature");
  return features.reshaped({1, feature_count_});
}

std::vector<float> Predictor::scores(const Tensor& features, std::span<const Pose> poses) const {
  check(features.defined() && features.shape() == Shape{1, feature_count_} && features.dtype() == DType::f32,
        "[predict] features are ", features.defined() ? to_string(features.shape()) : "none", ", the model expects ",
        to_string({1, feature_count_}), " f32");
  check_finite(features, "feature");
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::string problem = pose_problem(poses[i]);
    check(problem.empty(), "[predict] pose ", i, ": ", problem);
  }
  const Index count = static_cast<Index>(poses.size()), angles = angle_count(angles_);
  const Index dimension = feature_count_ / orientations_;
  std::vector<float> result(poses.size(), 0.0f);
  for (int orientation = 0; orientation < orientations_; ++orientation)
    for (Index begin = 0; begin < count; begin += kPosesAtOnce) {
      const Index size = std::min(kPosesAtOnce, count - begin);
      Tensor repeated = Tensor::empty({size, dimension}), encoded = Tensor::empty({size, angles});
      for (Index i = 0; i < size; ++i) {
        const Pose& pose = poses[static_cast<std::size_t>(begin + i)];
        // Within one turn: a model that is fed plain angles has seen no other.
        const double theta_deg = oriented_theta_deg(orientation, pose.theta_deg);
        std::copy_n(features.data<float>() + orientation * dimension, dimension,
                    repeated.data<float>() + i * dimension);
        encode_angles(angles_, theta_deg, pose.phi_deg, encoded.data<float>() + i * angles);
      }
      const Tensor values = head_.run({repeated, encoded});
      check_finite(values, "score", static_cast<std::size_t>(begin));
      for (Index i = 0; i < size; ++i)
        result[static_cast<std::size_t>(begin + i)] += values.data<float>()[i] / static_cast<float>(orientations_);
    }
  return result;
}

std::size_t best_view(std::span<const float> scores) {
  check(!scores.empty(), "[predict] there is no pose to choose from");
  return static_cast<std::size_t>(std::max_element(scores.begin(), scores.end()) - scores.begin());
}

std::vector<std::size_t> best_first(std::span<const float> scores) {
  std::vector<std::size_t> order(scores.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return scores[a] > scores[b]; });
  return order;
}

}  // namespace svnet
