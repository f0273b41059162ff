#include "train/stages/cross_validation.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "io/files/make_folder.h"
#include "train/dataset_rows.h"
#include "train/random_problems.h"
#include "train/selectors.h"
#include "train/stages/model.h"
#include "train/stages/pipeline_distances.h"
#include "train/stages/predictions.h"
#include "train/stages/scores.h"

namespace svnet::train {
namespace {

/// The selectors of the table, in this order, if the configuration names none.
const std::vector<std::string> kSelectors{"top", "rand", "broadside", "phi_map", "svnet", "opt_glob", "opt_ind"};

/// The run with the categories of a fold held out, in a folder of its own.
Run run_of_fold(const Run& run, const Fold& fold, std::size_t number) {
  Run part = run;
  part.config.dataset.held_out = fold;
  part.held_out = named_categories(run.dataset, fold, "fold");
  part.folder = run.folder / joined("fold-", number);
  io::make_folder(part.folder);
  return part;
}

/// The run without rounds of on-policy scores: true scores of views do not depend on a model.
Run with_uniform_views(const Run& run) {
  Run uniform = run;
  uniform.config.scores.rounds = 0;
  return uniform;
}

/// Copies what a fold chose or predicted for its own categories.
template <class T>
void take_held_out(const Run& fold, const std::vector<T>& from, std::vector<T>& to, auto category_of) {
  for (std::size_t i = 0; i < from.size(); ++i)
    if (fold.held_out[static_cast<std::size_t>(category_of(i))]) to[i] = from[i];
}

}  // namespace

std::vector<Fold> drawn_folds(const ViewDataset& dataset, Index count, std::uint64_t seed) {
  const auto categories = static_cast<Index>(dataset.categories.size());
  check(count >= 2 && count <= categories && categories - (categories + count - 1) / count >= 2, "[folds] ", categories,
        " categories cannot be split into ", count, " folds that leave 2 categories or more to train on");
  std::vector<std::string> order = dataset.categories;
  RandomStream random(seed, Stream::cross_validation);
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i))]);
  std::vector<Fold> folds(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < order.size(); ++i) folds[i % folds.size()].push_back(order[i]);
  return folds;
}

std::vector<Fold> completed_folds(const ViewDataset& dataset, std::vector<Fold> given) {
  std::set<std::string> named;
  for (const Fold& fold : given) {
    static_cast<void>(named_categories(dataset, fold, "--fold"));
    for (const std::string& category : fold)
      check(named.insert(category).second, "--fold: the category '", category, "' is named twice");
  }
  Fold rest;
  for (const std::string& category : dataset.categories)
    if (named.count(category) == 0) rest.push_back(category);
  if (!rest.empty()) given.push_back(rest);
  for (const Fold& fold : given)
    check(fold.size() + 2 <= dataset.categories.size(), "--fold: ", fold.size(), " categories of ",
          dataset.categories.size(), " leave fewer than 2 to train on");
  return given;
}

CrossValidation cross_validate(const Run& run, FeaturesStage& features, const std::vector<Fold>& folds) {
  check(run.config.dataset.held_out.empty(), "[folds] the configuration holds categories out of every fold");
  const Scores scores = scores_stage(with_uniform_views(run), features);
  const auto& target = run.config.sv_net.target == Target::individual ? scores.individual : scores.global;
  const auto& named = run.config.evaluation.selectors.empty() ? kSelectors : run.config.evaluation.selectors;
  const auto kinds = selectors_of_table(named, Split::held_out);

  CrossValidation result;
  std::vector<double> predicted(run.dataset.views.size(), 0);
  std::map<std::string, std::vector<std::int32_t>> chosen;
  for (std::size_t f = 0; f < folds.size(); ++f) {
    run.say(joined("fold ", f + 1, " of ", folds.size(), ": without ", joined_with(", ", folds[f])));
    const Run fold = run_of_fold(run, folds[f], f + 1);
    const Scores training_scores = scores_stage(fold, features);
    const Model model = model_stage(fold, features, training_scores);
    const std::vector<double> of_fold = predicted_scores(fold, features, model);
    take_held_out(fold, of_fold, predicted, [&](std::size_t view) { return run.dataset.views[view].category; });
    const SelectorInputs inputs{
        .dataset = run.dataset,
        .scores =
            [&] {
              return ViewScores{scores.individual, scores.global};
            },
        .predicted = of_fold,
        .training_scores = training_scores,
        .frames = [&]() -> const std::vector<frame::TopFrame>& { return features.frames(run.config.sv_net.depth); }};
    for (const SelectorKind* kind : kinds) {
      const std::vector<std::int32_t> views = kind->view(inputs);
      auto& all = chosen.try_emplace(kind->name, views.size()).first->second;
      take_held_out(fold, views, all, [&](std::size_t pose) { return run.dataset.poses[pose].category; });
    }
    result.folds.push_back({folds[f], within_pose(run.dataset, predicted, target, fold.held_out)});
  }
  const std::vector<bool> all(run.dataset.categories.size(), true), none(run.dataset.categories.size(), false);
  result.within_pose = within_pose(run.dataset, predicted, target, all);

  std::vector<Selector> selectors;
  for (const SelectorKind* kind : kinds) selectors.push_back({kind->name, chosen.at(kind->name)});
  PipelineDistances distances(run.config, features);
  const std::vector<EvaluationPipeline> pipelines = distances.pipelines();
  const EvaluationOptions options{.problems = static_cast<std::uint64_t>(run.config.evaluation.problems),
                                  .seed = run.seed(),
                                  .nmi = run.config.evaluation.nmi,
                                  .baselines = {"top", "rand", "broadside", "phi_map"}};
  result.table = evaluate(run.dataset, clustering_problems(run.dataset, none, run.config.scores), pipelines, selectors,
                          options, Parallel::shared(), run.messages, "evaluation, all categories");
  return result;
}

}  // namespace svnet::train
