#include "train/stages/round_predictor.h"

#include "base/text.h"
#include "io/files/make_folder.h"
#include "train/stages/model.h"
#include "train/stages/predictions.h"

namespace svnet::train {

RoundPredictor sv_net_round_predictor(const Run& run, FeaturesStage& features) {
  return [&run, &features, round = Index{0}](const Scores& scores) mutable {
    Run training = run;
    training.config.scores.rounds = round++;                  // of the scores that this model is trained on
    training.config.sv_net.next_view = NextViewChoice::none;  // only the last model is used
    training.folder = run.folder / joined("round-", round);
    io::make_folder(training.folder);
    return predicted_scores(training, features, model_stage(training, features, scores));
  };
}

}  // namespace svnet::train
