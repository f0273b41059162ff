#include "train/stages/evaluation.h"

#include "base/parallel.h"
#include "io/files/atomic_file.h"
#include "train/random_problems.h"
#include "train/stage_times.h"
#include "train/stages/evaluation_options.h"
#include "train/stages/held_out_scores.h"
#include "train/stages/pipeline_distances.h"

namespace svnet::train {
namespace {

std::vector<Selector> selectors(const Run& run, Split split, const SelectorInputs& inputs) {
  return chosen_by(selectors_of_table(run.config.evaluation.selectors, split), inputs, run.config.evaluation.views);
}

}  // namespace

EvaluationTables evaluation_stage(const Run& run, const EvaluationInputs& inputs, std::uint64_t problems,
                                  const std::optional<std::filesystem::path>& copy) {
  StageTimer timer(run, "evaluation");
  PipelineDistances distances(run.config, inputs.features);
  const std::vector<EvaluationPipeline> pipelines = distances.pipelines();
  const EvaluationOptions options = evaluation_options(run.config, problems);
  const auto table = [&](const std::vector<bool>& excluded, const std::vector<Selector>& selectors,
                         const std::string& task) {
    return evaluate(run.dataset, {{clustering_problems(run.dataset, excluded, run.config.scores), selectors}},
                    pipelines, options, Parallel::shared(), run.messages, task);
  };

  const auto frames = [&]() -> const std::vector<frame::TopFrame>& {
    return inputs.features.frames(run.config.sv_net.depth);
  };
  EvaluationTables tables;
  const SelectorInputs in_training{.dataset = run.dataset,
                                   .scores =
                                       [&] {
                                         return ViewScores{inputs.scores.individual, inputs.scores.global};
                                       },
                                   .predicted = inputs.predicted,
                                   .training_scores = inputs.scores,
                                   .frames = frames,
                                   .next = inputs.next};
  tables["training"] =
      table(run.held_out, selectors(run, Split::training, in_training), "evaluation, training categories");
  if (run.has_held_out_problems()) {
    std::optional<semantics::SemanticScores> scores;
    const SelectorInputs in_held_out{.dataset = run.dataset,
                                     .scores =
                                         [&] {
                                           if (inputs.held_out == nullptr && !scores)
                                             scores = held_out_scores(run, inputs.features, problems);
                                           const auto& known = inputs.held_out != nullptr ? *inputs.held_out : *scores;
                                           return ViewScores{known.individual, known.global};
                                         },
                                     .predicted = inputs.predicted,
                                     .training_scores = inputs.scores,
                                     .frames = frames,
                                     .next = inputs.next};
    tables["held_out"] = table(run.training_categories(), selectors(run, Split::held_out, in_held_out),
                               "evaluation, held-out categories");
  } else {
    run.say("evaluation: fewer than 2 held-out categories, no table of them");
  }
  const std::string json = tables_json(tables);
  io::write_atomically(run.folder / "evaluation.json", json);
  if (copy) io::write_atomically(*copy, json);
  timer.made();
  return tables;
}

}  // namespace svnet::train
