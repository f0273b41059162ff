#include "train/head_fit.h"

#include <algorithm>
#include <cstdio>

#include "base/error.h"
#include "base/text.h"
#include "train/gain_fit.h"
#include "train/pose_examples.h"

namespace svnet::train {
namespace {

/// The share of the ridge regression in a kind of head.
double ridge_share(HeadChoice kind) {
  switch (kind) {
    case HeadChoice::ridge:
      return 1;
    case HeadChoice::both:
      return 0.5;
    case HeadChoice::network:
      return 0;
    case HeadChoice::best:
      break;
  }
  fail("[head] 'best' is not a kind of head");
}

std::vector<Parameters> fit_networks(const PoseExamples& examples, std::uint64_t seed) {
  std::vector<Parameters> networks;
  for (std::size_t i = 0; i < kNetworks; ++i) networks.push_back(fit_network(examples, {.seed = seed * kNetworks + i}));
  return networks;
}

std::vector<double> ridge_predictions(const RidgeFit& fit, const PoseExamples& examples) {
  const auto inputs = static_cast<std::size_t>(examples.inputs);
  std::vector<double> predicted(examples.x.size() / inputs, fit.bias);
  for (std::size_t i = 0; i < examples.x.size(); ++i) predicted[i / inputs] += fit.weights[i % inputs] * examples.x[i];
  return predicted;
}

std::vector<double> mean_predictions(const std::vector<Parameters>& networks, const PoseExamples& examples) {
  std::vector<double> mean(examples.x.size() / static_cast<std::size_t>(examples.inputs));
  for (const Parameters& network : networks) {
    const std::vector<double> predicted = network_predictions(network, examples, {});
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += predicted[i] / static_cast<double>(networks.size());
  }
  return mean;
}

std::vector<double> mixture(const std::vector<double>& ridge, const std::vector<double>& networks, double share) {
  std::vector<double> mixed(ridge.size());
  for (std::size_t i = 0; i < mixed.size(); ++i) mixed[i] = share * ridge[i] + (1 - share) * networks[i];
  return mixed;
}

/// The examples of the categories in `fold`, or of all others.
PoseExamples part_of(const PoseExamples& e, const std::map<std::int32_t, std::size_t>& folds, std::size_t fold,
                     bool inside) {
  PoseExamples part{.inputs = e.inputs};
  for (std::size_t i = 0; i < e.y.size(); ++i) {
    if ((folds.at(e.category[i]) == fold) != inside) continue;
    const auto row = e.x.begin() + static_cast<std::ptrdiff_t>(i) * e.inputs;
    part.x.insert(part.x.end(), row, row + e.inputs);
    part.y.push_back(e.y[i]);
    part.weight.push_back(e.weight[i]);
    part.pose.push_back(e.pose[i]);
    part.category.push_back(e.category[i]);
    if (!e.top.empty()) part.top.push_back(e.top[i]);
  }
  return part;
}

WithinPose within_poses(const PoseExamples& e, const std::vector<double>& predicted) {
  std::vector<WithinPose> poses;
  for (const auto& [begin, end] : pose_ranges(e.pose))
    poses.push_back(within_one_pose(std::span(predicted).subspan(begin, end - begin),
                                    std::span(e.y).subspan(begin, end - begin), std::nullopt));
  return mean_of(poses);
}

std::vector<TriedHead> try_heads(const PoseExamples& examples, const RidgeOptions& options) {
  const auto folds = folds_of_categories(examples, options.seed);
  std::vector<TriedHead> tried{{HeadChoice::ridge, {}}, {HeadChoice::network, {}}, {HeadChoice::both, {}}};
  std::vector<std::vector<WithinPose>> parts(tried.size());
  for (std::size_t fold = 0; fold < std::min(kRidgeFolds, folds.size()); ++fold) {
    const PoseExamples rest = part_of(examples, folds, fold, false), left_out = part_of(examples, folds, fold, true);
    const std::vector<double> ridge = ridge_predictions(fit_ridge(rest, options), left_out),
                              networks = mean_predictions(fit_networks(rest, options.seed), left_out);
    for (std::size_t i = 0; i < tried.size(); ++i)
      parts[i].push_back(within_poses(left_out, mixture(ridge, networks, ridge_share(tried[i].kind))));
  }
  for (std::size_t i = 0; i < tried.size(); ++i) tried[i].within_pose = mean_of(parts[i]);
  return tried;
}

HeadChoice best_of(const std::vector<TriedHead>& tried) {
  const auto lower = [](const TriedHead& a, const TriedHead& b) {
    return a.within_pose.spearman < b.within_pose.spearman;
  };
  return std::max_element(tried.begin(), tried.end(), lower)->kind;
}

HeadFit fit_of_kind(const PoseExamples& examples, const RidgeOptions& options, HeadChoice kind) {
  HeadFit head{.ridge = fit_ridge(examples, options), .ridge_share = ridge_share(kind)};
  if (kind != HeadChoice::ridge) head.networks = fit_networks(examples, options.seed);
  return head;
}

}  // namespace

GainCalibration gain_of_left_out(const PoseExamples& examples, const std::vector<double>& scores,
                                 const RidgeOptions& options, const HeadFit& head) {
  const auto folds = folds_of_categories(examples, options.seed);
  if (examples.top.empty() || folds.size() < 3) return {};
  const HeadChoice kind = head.ridge_share == 1   ? HeadChoice::ridge
                          : head.ridge_share == 0 ? HeadChoice::network
                                                  : HeadChoice::both;
  PoseExamples measured = examples;
  measured.y = scores;
  std::vector<PoseGain> gains;
  for (std::size_t fold = 0; fold < std::min(kRidgeFolds, folds.size()); ++fold) {
    const PoseExamples left_out = part_of(examples, folds, fold, true);
    const HeadFit rest = fit_of_kind(part_of(examples, folds, fold, false), options, kind);
    const std::vector<PoseGain> of_fold = gains_of(part_of(measured, folds, fold, true), predictions(rest, left_out));
    gains.insert(gains.end(), of_fold.begin(), of_fold.end());
  }
  return fitted_gain(gains);
}

HeadFit fit_head(const PoseExamples& examples, const RidgeOptions& options, HeadChoice choice) {
  HeadFit head{.ridge = fit_ridge(examples, options)};
  // A fold needs two other categories to fit to.
  const bool can_try = folds_of_categories(examples, options.seed).size() >= 3;
  if (choice == HeadChoice::best && can_try) head.tried = try_heads(examples, options);
  const HeadChoice kind = choice == HeadChoice::best ? (can_try ? best_of(head.tried) : HeadChoice::ridge) : choice;
  head.ridge_share = ridge_share(kind);
  if (kind != HeadChoice::ridge) head.networks = fit_networks(examples, options.seed);
  return head;
}

std::vector<double> predictions(const HeadFit& head, const PoseExamples& examples) {
  const std::vector<double> ridge = ridge_predictions(head.ridge, examples);
  if (head.networks.empty()) return ridge;
  return mixture(ridge, mean_predictions(head.networks, examples), head.ridge_share);
}

std::string tried_text(const std::vector<TriedHead>& tried) {
  std::vector<std::string> texts;
  for (const TriedHead& head : tried) {
    char spearman[32];
    std::snprintf(spearman, sizeof spearman, " %.3f", head.within_pose.spearman);
    texts.push_back(std::string(name_of(head.kind)) + spearman);
  }
  return joined_with(", ", texts);
}

void set_linear(Parameters& parameters, const RidgeFit& fit, double factor) {
  const auto inputs = static_cast<Index>(fit.weights.size());
  Tensor kernel = Tensor::empty({inputs, 1}), bias = Tensor::empty({1});
  for (Index i = 0; i < inputs; ++i)
    kernel.data<float>()[i] = static_cast<float>(factor * fit.weights[static_cast<std::size_t>(i)]);
  bias.data<float>()[0] = static_cast<float>(factor * fit.bias);
  parameters.set("ridge/kernel", kernel);
  parameters.set("ridge/bias", bias);
}

void set_head(Model& model, const HeadFit& head) {
  const auto inputs = static_cast<Index>(head.ridge.weights.size()),
             networks = static_cast<Index>(head.networks.size());
  // With the linear part alone the factor is in its kernel, otherwise in the last layer.
  set_linear(model.head_parameters, head.ridge, networks == 0 ? models::kLogitPerScore : 1);
  if (networks == 0) {
    model.head = models::linear_head(inputs);
    return;
  }
  model.head = models::mixed_head(inputs, networks);
  for (Index i = 0; i < networks; ++i)
    for (const auto& [name, tensor] : head.networks[static_cast<std::size_t>(i)].items())
      model.head_parameters.set(models::network_prefix(i + 1) + name, tensor);
  Tensor mean = Tensor::empty({networks + 1, 1});
  mean.data<float>()[0] = static_cast<float>(models::kLogitPerScore * head.ridge_share);
  for (Index i = 1; i <= networks; ++i)
    mean.data<float>()[i] =
        static_cast<float>(models::kLogitPerScore * (1 - head.ridge_share) / static_cast<double>(networks));
  model.head_parameters.set("mean/kernel", mean);
  model.head_parameters.set("mean/bias", Tensor::zeros({1}));
}

}  // namespace svnet::train
