#include "train/stages/fingerprints.h"

#include <iomanip>

#include "base/sha256.h"
#include "base/text.h"
#include "view/symmetry.h"

namespace svnet {

std::string sampler_text(const Config::Scores& s) {
  const auto bound = [](Index value) { return value == 0 ? std::string("all") : std::to_string(value); };
  return joined("uniform; categories ", s.min_categories, " to ", bound(s.max_categories), ", objects ", s.min_objects,
                " to ", bound(s.max_objects), ", one pose, one view; singletons ", name_of(s.singletons));
}

std::string scores_fingerprint(const std::string& features_fingerprint, const Config& config) {
  const auto& s = config.scores;
  Sha256 hash;
  hash.update_field("scores 1")
      .update_field(features_fingerprint)
      .update_field(joined_with("\n", config.dataset.held_out));
  hash.update_field(sampler_text(s)).update_field(name_of(s.clustering));
  hash.update_field(joined(config.seed, " ", s.problems, " ", s.min_samples, " ", std::hexfloat, s.target_error));
  return hash.hex();
}

std::string model_fingerprint(const std::string& features, const std::string& scores, const Config& config) {
  const auto& n = config.sv_net;
  const auto& t = config.training;
  Sha256 hash;
  hash.update_field("model 1").update_field(features).update_field(scores).update_field(
      joined_with("\n", config.dataset.held_out));
  hash.update_field(joined(config.seed, " ", n.width, " ", static_cast<int>(n.angles), " ", static_cast<int>(n.target),
                           " ", t.epochs, " ", t.batch_size, " ", static_cast<int>(t.optimizer), " ",
                           static_cast<int>(t.schedule), " ", t.step_epochs, " ", t.validation_categories, " ",
                           std::hexfloat, n.dropout, " ", t.learning_rate, " ", t.momentum, " ", t.step_factor));
  if (t.fine_tune != FineTune::none) hash.update_field(joined("fine_tune ", static_cast<int>(t.fine_tune)));
  if (n.orientations != Orientations::as_taken) hash.update_field("all orientations");
  if (t.augmentation != TopViewAugmentation::none)
    hash.update_field(joined("augmentation ", static_cast<int>(t.augmentation)));
  return hash.hex();
}

ScoreOptions score_options(const Config& config, Index dimension) {
  const auto& s = config.scores;
  return {.problems = static_cast<std::uint64_t>(s.problems),
          .min_samples = static_cast<std::uint64_t>(s.min_samples),
          .target_error = s.target_error,
          .seed = static_cast<std::uint64_t>(config.seed),
          .singletons = s.singletons,
          .clustering = {.method = s.clustering, .dimension = dimension}};
}

int scored_orientations(const Config& config) {
  return config.sv_net.orientations == Orientations::all ? kSymmetries : 1;
}

int trained_orientations(const Config& config) {
  return config.training.augmentation == TopViewAugmentation::turns ? kSymmetries : 1;
}

TrainerOptions trainer_options(const Config& config, const std::string& fingerprint) {
  const auto& t = config.training;
  return {.epochs = t.epochs,
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

}  // namespace svnet
