#include "train/next_head.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/error.h"
#include "models/pose_head.h"
#include "train/head_fit.h"
#include "train/pose_examples.h"
#include "train/view_targets.h"

namespace svnet::train {
namespace {

view::CameraPose pose_of(const View& view) {
  return {.theta_deg = static_cast<double>(view.theta_deg), .phi_deg = static_cast<double>(view.phi_deg)};
}

struct Pair {
  std::int32_t taken, candidate;
  double score, standard_error;
};

/// Both orders of each pair with a score, sorted by the taken view.
std::vector<Pair> ordered(const semantics::ViewSets& pairs, const Scores& scores) {
  std::vector<Pair> both;
  for (Index i = 0; i < pairs.count(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (!std::isfinite(scores.individual[at])) continue;
    const auto set = pairs.set(i);
    both.push_back({set[0], set[1], scores.individual[at], scores.standard_error[at]});
    both.push_back({set[1], set[0], scores.individual[at], scores.standard_error[at]});
  }
  std::ranges::sort(both, {}, [](const Pair& pair) { return std::tuple(pair.taken, pair.candidate); });
  return both;
}

}  // namespace

RidgeFit fit_next_head(const ViewsBeside& views, const semantics::ViewSets& pairs, const Scores& scores,
                       std::uint64_t seed) {
  check(pairs.size == 2 && static_cast<Index>(scores.individual.size()) == pairs.count(), "[next] ",
        scores.individual.size(), " scores for ", pairs.count(), " pairs");
  const auto columns = static_cast<std::size_t>(frame::next_input_count(views.spec));
  const auto feature_count = static_cast<std::size_t>(frame::feature_count(views.spec));
  PoseExamples examples{.inputs = static_cast<Index>(columns)};
  std::vector<double> standard_errors, inputs(columns);
  for (const Pair& pair : ordered(pairs, scores)) {
    const View& taken = views.dataset.views[static_cast<std::size_t>(pair.taken)];
    const View& candidate = views.dataset.views[static_cast<std::size_t>(pair.candidate)];
    const frame::TakenView seen{pose_of(taken), views.shapes[static_cast<std::size_t>(pair.taken)]};
    frame::NextInputs(
        views.spec,
        std::span(views.features).subspan(static_cast<std::size_t>(taken.pose) * feature_count, feature_count),
        std::span(&seen, 1))
        .write(pose_of(candidate), inputs);
    examples.x.insert(examples.x.end(), inputs.begin(), inputs.end());
    examples.y.push_back(pair.score);
    standard_errors.push_back(pair.standard_error);
    examples.pose.push_back(pair.taken);  // differences are learned beside one taken view
    examples.category.push_back(static_cast<std::int32_t>(taken.category));
  }
  examples.weight = score_weights(examples.y, standard_errors, examples.pose);
  RidgeOptions options{.seed = seed};
  for (const frame::InputGroup group : frame::next_input_groups(views.spec))
    options.small_penalty.push_back(!frame::is_of_shape(group));
  return fit_ridge(examples, options);
}

void set_next_head(Model& model, const RidgeFit& fit) {
  model.next_head = models::linear_head(static_cast<Index>(fit.weights.size()));
  set_linear(model.next_parameters, fit, models::kLogitPerScore);
}

}  // namespace svnet::train
