#include "semantics/on_policy_weights.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace svnet::semantics {
namespace {

/// softmax(sharpness * scaled); scaled: (views) in [-1, 0], at least one of them 0.
void softmax(const std::vector<double>& scaled, double sharpness, std::vector<double>& probability) {
  probability.resize(scaled.size());
  double sum = 0;
  for (std::size_t i = 0; i < scaled.size(); ++i) sum += probability[i] = std::exp(sharpness * scaled[i]);
  for (double& p : probability) p /= sum;
}

double effective_number(const std::vector<double>& probability) {
  double entropy = 0;
  for (const double p : probability)
    if (p > 0) entropy -= p * std::log(p);
  return std::exp(entropy);
}

/// The softmax of finite predictions with that effective number, or as near to it as they allow.
std::vector<double> softmax_of(std::span<const double> prediction, double wanted) {
  const auto [lowest, highest] = std::minmax_element(prediction.begin(), prediction.end());
  const double spread = *highest - *lowest;
  std::vector<double> scaled, probability;
  for (const double p : prediction) scaled.push_back(spread > 0 ? (p - *highest) / spread : 0);
  // The effective number falls from all views to those with the highest prediction as the sharpness grows.
  double soft = 0, sharp = 0x1p20;
  constexpr int kSteps = 60;
  for (int step = 0; step < kSteps; ++step) {
    const double middle = (soft + sharp) / 2;
    softmax(scaled, middle, probability);
    (effective_number(probability) > wanted ? soft : sharp) = middle;
  }
  softmax(scaled, sharp, probability);
  return probability;
}

}  // namespace

ViewWeights on_policy_weights(std::span<const double> prediction, std::span<const std::int32_t> pose_of_view,
                              const OnPolicyOptions& options) {
  check(prediction.size() == pose_of_view.size(), "[on-policy] ", prediction.size(), " predictions of ",
        pose_of_view.size(), " views");
  check(options.effective_share > 0 && options.effective_share <= 1 && options.uniform_share > 0 &&
            options.uniform_share <= 1,
        "[on-policy] effective share ", options.effective_share, ", uniform share ", options.uniform_share,
        "; both must be above 0 and at most 1");
  std::vector<std::vector<std::size_t>> poses;
  for (std::size_t v = 0; v < pose_of_view.size(); ++v) {
    check(pose_of_view[v] >= 0, "[on-policy] view ", v, " has pose ", pose_of_view[v], "; poses are numbered from 0");
    if (std::ssize(poses) <= pose_of_view[v]) poses.resize(pose_of_view[v] + 1);
    poses[pose_of_view[v]].push_back(v);
  }

  ViewWeights weights(prediction.size());
  std::vector<std::size_t> predicted;  // views of the pose with a finite prediction
  std::vector<double> values;          // their predictions
  for (const auto& views : poses) {
    predicted.clear();
    values.clear();
    for (const std::size_t v : views)
      if (std::isfinite(prediction[v])) {
        predicted.push_back(v);
        values.push_back(prediction[v]);
      }
    const double uniform_share = predicted.empty() ? 1 : options.uniform_share;
    for (const std::size_t v : views) weights[v] = uniform_share / views.size();
    if (predicted.empty()) continue;
    const std::vector<double> preferred = softmax_of(values, options.effective_share * views.size());
    for (std::size_t i = 0; i < predicted.size(); ++i) weights[predicted[i]] += (1 - uniform_share) * preferred[i];
  }
  return weights;
}

}  // namespace svnet::semantics
