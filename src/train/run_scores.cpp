#include "train/run.h"
#include "train/scores_stage.h"

namespace svnet {

const Scores& Run::scores() {
  if (scores_) return *scores_;
  const Features& features = this->features(config_.scores.backbone, config_.scores.layer);
  const std::string wanted = scores_fingerprint(features.input_fingerprint, config_);
  const auto path = folder_ / "scores.h5";
  if (std::filesystem::exists(path)) try {
      if (Scores scores = read_scores(path); scores.input_fingerprint == wanted) {
        say("scores: reused scores.h5");
        return scores_.emplace(std::move(scores));
      }
    } catch (const Error& error) {
      say(joined("made again: ", error.what()));
    }
  Scores scores = make_scores(dataset_, features, held_out_, config_, messages_);
  write_scores(path, scores);
  return scores_.emplace(std::move(scores));
}

}  // namespace svnet
