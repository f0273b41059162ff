#include "train/reused_file.h"
#include "train/run.h"
#include "train/scores_stage.h"
#include "train/stages/fingerprints.h"

namespace svnet {

const Scores& Run::scores() {
  if (scores_) return *scores_;
  const Features& features = this->features(config_.scores.backbone, config_.scores.layer);
  const std::string wanted = scores_fingerprint(features.input_fingerprint, config_);
  const auto path = folder_ / "scores.h5";
  if (auto scores = reused_file(path, wanted, read_scores, communicator_, messages_)) {
    say("scores: reused scores.h5");
    return scores_.emplace(std::move(*scores));
  }
  return scores_.emplace(make_scores(path, dataset_, features, held_out_, config_, messages_,
                                     {.resume = ScoresRun::Resume::same, .communicator = communicator_}));
}

}  // namespace svnet
