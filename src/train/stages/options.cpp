#include "train/stages/options.h"

#include "base/error.h"
#include "semantics/on_policy_weights.h"
#include "view/symmetry.h"

namespace svnet::train {

std::string sampler_text(const Config::Scores& s, bool on_policy) {
  const auto bound = [](Index value) { return value == 0 ? std::string("all") : std::to_string(value); };
  const semantics::OnPolicyOptions policy;
  const std::string how = on_policy
                              ? joined(" on-policy (softmax of predictions over effectively ", policy.effective_share,
                                       " of the views, ", policy.uniform_share, " uniform)")
                              : "";
  return joined("uniform; categories ", s.min_categories, " to ", bound(s.max_categories), ", objects ", s.min_objects,
                " to ", bound(s.max_objects), ", one pose, one view", how, "; singletons ", name_of(s.singletons));
}

semantics::ScoreOptions score_options(const Config& config, Index dimension) {
  const auto& s = config.scores;
  return {.problems = static_cast<std::uint64_t>(s.problems),
          .min_samples = static_cast<std::uint64_t>(s.min_samples),
          .target_error = s.target_error,
          .seed = static_cast<std::uint64_t>(config.seed),
          .singletons = s.singletons,
          .clustering = {.method = s.clustering, .dimension = dimension}};
}

int scored_orientations(const Config& config) {
  return config.sv_net.orientations == Orientations::all ? view::kSymmetries : 1;
}

int trained_orientations(const Config& config) {
  return config.training.augmentation == TopViewAugmentation::turns ? view::kSymmetries : 1;
}

TrainerOptions trainer_options(const Config& config, const std::string& fingerprint) {
  const auto& t = config.training;
  return {.epochs = t.epochs,
          .patience = t.patience,
          .batch_size = t.batch_size,
          .optimizer = {.kind = t.optimizer, .momentum = t.momentum},
          .schedule = {},
          .seed = static_cast<std::uint64_t>(config.seed),
          .input_fingerprint = fingerprint};
}

Schedule learning_rate_schedule(const Config& config, Index steps_per_epoch) {
  const auto& t = config.training;
  return {.kind = t.schedule,
          .base = t.learning_rate,
          .period = t.step_epochs * steps_per_epoch,
          .factor = t.step_factor,
          .total = t.epochs * steps_per_epoch};
}

}  // namespace svnet::train
