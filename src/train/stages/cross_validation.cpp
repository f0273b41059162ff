#include "train/stages/cross_validation.h"

#include <set>
#include <span>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "io/files/make_folder.h"
#include "train/dataset_rows.h"
#include "train/random_problems.h"
#include "train/selectors.h"
#include "train/shuffled.h"
#include "train/stage_times.h"
#include "train/stages/contact_sheet.h"
#include "train/stages/evaluation_options.h"
#include "train/stages/model.h"
#include "train/stages/pipeline_distances.h"
#include "train/stages/predictions.h"
#include "train/stages/scores.h"
#include "train/view_targets.h"

namespace svnet::train {
namespace {

/// The selectors of the table, in this order, if the configuration names none.
const std::vector<std::string> kSelectorsOfTable{"top", "rand", "broadside", "phi_map", "svnet", "opt_glob", "opt_ind"};

/// The run with the categories of a fold held out, in a folder of its own.
Run run_of_fold(const Run& run, const Fold& fold, std::size_t number) {
  Run part = run;
  part.config.dataset.held_out = fold;
  part.held_out = named_categories(run.dataset, fold, "fold");
  part.folder = run.folder / joined("fold-", number);
  io::make_folder(part.folder);
  return part;
}

/// What a fold's model predicts, and the views that each selector chooses with it, for all poses.
struct FoldChoices {
  std::vector<double> predicted;
  GainCalibration gain;
  std::vector<Selector> selectors;
};

FoldChoices choices_of(const Run& fold, FeaturesStage& features, const Scores& true_scores,
                       const std::vector<const SelectorKind*>& kinds) {
  const Scores training_scores = scores_stage(fold, features);
  const Model model = model_stage(fold, features, training_scores);
  FoldChoices choices{.predicted = predicted_scores(fold, features, model), .gain = model.gain, .selectors = {}};
  const SelectorInputs inputs{
      .dataset = fold.dataset,
      .scores =
          [&] {
            return ViewScores{true_scores.individual, true_scores.global};
          },
      .predicted = choices.predicted,
      .training_scores = training_scores,
      .frames = [&]() -> const std::vector<frame::TopFrame>& { return features.frames(fold.config.sv_net.depth); },
      .next = next_scores(fold, features, model)};
  choices.selectors = chosen_by(kinds, inputs, fold.config.evaluation.views);
  return choices;
}

/// Puts the choices for the fold's own categories into `all`.
void take_held_out(const Run& fold, const std::vector<Selector>& from, std::vector<Selector>& all) {
  for (std::size_t s = 0; s < from.size(); ++s) {
    if (s == all.size()) all.push_back(from[s]);
    const auto views = static_cast<std::size_t>(from[s].views);
    for (std::size_t i = 0; i < from[s].view.size(); ++i)
      if (fold.held_out[static_cast<std::size_t>(fold.dataset.poses[i / views].category)])
        all[s].view[i] = from[s].view[i];
  }
}

/// The mean over the folds that hold a view's category out.
class HeldOutMean {
 public:
  explicit HeldOutMean(std::size_t views) : sum_(views), count_(views) {}
  void add(const Run& fold, std::span<const double> predicted) {
    for (std::size_t v = 0; v < sum_.size(); ++v)
      if (fold.held_out[static_cast<std::size_t>(fold.dataset.views[v].category)]) {
        sum_[v] += predicted[v];
        ++count_[v];
      }
  }
  /// NaN for views that no fold holds out.
  std::vector<double> means() const {
    std::vector<double> means;
    for (std::size_t v = 0; v < sum_.size(); ++v) means.push_back(sum_[v] / count_[v]);
    return means;
  }

 private:
  std::vector<double> sum_, count_;
};

std::vector<bool> every_category(const Run& run) { return std::vector<bool>(run.dataset.categories.size(), true); }

/// The random problems of some categories.
semantics::ClusteringProblems problems_of(const Run& run, std::vector<bool> categories) {
  categories.flip();
  return clustering_problems(run.dataset, categories, run.config.scores);
}

}  // namespace

std::vector<Fold> drawn_folds(const ViewDataset& dataset, Index count, std::uint64_t seed) {
  const auto categories = static_cast<Index>(dataset.categories.size());
  check(count >= 2 && count <= categories && categories - (categories + count - 1) / count >= 2, "[folds] ", categories,
        " categories cannot be split into ", count, " folds that leave 2 categories or more to train on");
  RandomStream random(seed, Stream::cross_validation);
  const std::vector<std::string> order = shuffled(dataset.categories, random);
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

std::vector<Fold> each_choice_of(const ViewDataset& dataset, Index size) {
  const auto count = static_cast<Index>(dataset.categories.size());
  check(size >= 2 && size + 2 <= count, "--each-choice-of: ", size, " of ", count,
        " categories; it must be at least 2, and leave at least 2 to train on");
  std::vector<Fold> folds;
  std::vector<std::size_t> chosen(static_cast<std::size_t>(size));
  const auto choose = [&](auto& self, std::size_t place, std::size_t from) -> void {
    if (place == chosen.size()) {
      check(folds.size() < kMostFolds, "--each-choice-of: there are more than ", kMostFolds, " choices of ", size,
            " of ", count, " categories");
      Fold fold;
      for (const std::size_t category : chosen) fold.push_back(dataset.categories[category]);
      folds.push_back(std::move(fold));
      return;
    }
    for (std::size_t category = from; category < dataset.categories.size(); ++category) {
      chosen[place] = category;
      self(self, place + 1, category + 1);
    }
  };
  choose(choose, 0, 0);
  return folds;
}

CrossValidation cross_validate(const Run& run, FeaturesStage& features, const std::vector<Fold>& folds,
                               FoldProblems problems) {
  check(run.config.dataset.held_out.empty(), "[folds] the configuration holds categories out of every fold");
  const Scores scores = uniform_scores_stage(run, features);
  const auto& target = target_scores(scores, run.config.sv_net.target);
  const auto& named = run.config.evaluation.selectors.empty() ? kSelectorsOfTable : run.config.evaluation.selectors;
  const auto kinds = selectors_of_table(named, Split::held_out);

  CrossValidation result;
  std::vector<WithinPose> within_poses;
  std::vector<Selector> of_all_folds;
  std::vector<EvaluationSet> sets;
  HeldOutMean predicted(run.dataset.views.size());
  for (std::size_t f = 0; f < folds.size(); ++f) {
    run.say(joined("fold ", f + 1, " of ", folds.size(), ": without ", joined_with(", ", folds[f])));
    const Run fold = run_of_fold(run, folds[f], f + 1);
    const FoldChoices choices = choices_of(fold, features, scores, kinds);
    within_poses.push_back(within_pose(run.dataset, choices.predicted, target, fold.held_out));
    result.folds.push_back({folds[f], within_poses.back()});
    predicted.add(fold, choices.predicted);
    add_gains(run.dataset, choices.predicted, target, fold.held_out, choices.gain, result.gains);
    if (problems == FoldProblems::own_categories)
      sets.push_back({problems_of(run, fold.held_out), choices.selectors});
    else
      take_held_out(fold, choices.selectors, of_all_folds);
  }
  if (problems == FoldProblems::all_categories) sets.push_back({problems_of(run, every_category(run)), of_all_folds});
  result.within_pose = mean_of(within_poses);
  result.choices = std::move(of_all_folds);
  result.predicted = predicted.means();
  result.scores = scores;

  PipelineDistances distances(run.config, features);
  const EvaluationOptions options =
      evaluation_options(run.config, static_cast<std::uint64_t>(run.config.evaluation.problems));
  StageTimer timer(run, "evaluation");
  result.table = evaluate(run.dataset, sets, distances.pipelines(), options, Parallel::shared(), run.messages,
                          "evaluation, held-out categories");
  timer.made();
  return result;
}

std::optional<std::filesystem::path> cross_validation_sheet(const Run& run, const CrossValidation& validation) {
  std::vector<Selector> shown;
  for (const auto& [name, title] : {std::pair{"top", "top"}, {"svnet", "svnet"}, {"opt_ind", "best"}})
    for (const Selector& selector : validation.choices)
      if (selector.name == name) shown.push_back({title, selector.view});
  if (shown.size() < 3) return {};
  return write_contact_sheet(run, every_category(run), shown);
}

}  // namespace svnet::train
