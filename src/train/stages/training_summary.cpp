#include "train/stages/training_summary.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "train/selectors.h"
#include "train/stages/predictions.h"
#include "train/validation_categories.h"
#include "train/view_targets.h"

namespace svnet::train {
namespace {

/// The mean over the poses of `categories` of the score of the chosen view, or of all scored views if the selector
/// draws at random. Poses without a score do not count.
double mean_score(const Run& run, const std::vector<double>& scores, const std::vector<bool>& categories,
                  const std::vector<std::int32_t>& chosen) {
  double sum = 0;
  Index count = 0;
  for (std::size_t p = 0; p < run.dataset.poses.size(); ++p) {
    const ViewDataset::Pose& pose = run.dataset.poses[p];
    if (!categories[static_cast<std::size_t>(pose.category)]) continue;
    const Index first = chosen.empty() ? pose.first_view : chosen[p];
    const Index last = chosen.empty() ? pose.first_view + pose.view_count : first + 1;
    double of_pose = 0;
    Index scored = 0;
    for (Index v = first; v < last; ++v)
      if (const double score = scores[static_cast<std::size_t>(v)]; std::isfinite(score)) {
        of_pose += score;
        ++scored;
      }
    if (scored == 0) continue;
    sum += of_pose / static_cast<double>(scored);
    ++count;
  }
  return sum / static_cast<double>(count);
}

}  // namespace

std::vector<std::string> training_summary(const Run& run, FeaturesStage& features, const Scores& scores,
                                          const Model& model) {
  const CategoryUse use = category_use(run.held_out, run.config);
  const bool validated = std::ranges::find(use.validate, true) != use.validate.end();
  const std::vector<double>& target = target_scores(scores, run.config.sv_net.target);
  const std::vector<double> predicted = predicted_scores(run, features, model);

  std::vector<std::string> lines{
      joined("SV-net learnt from ", model.trained_on.top_views, " top views of ", model.trained_on.objects,
             " objects in ", model.trained_on.categories.size(), " categories"),
      joined("mean score of the views that it chooses, beside other choices, in categories that it ",
             validated ? "did not learn from:" : "learnt from:")};
  const SelectorInputs inputs{
      .dataset = run.dataset,
      .scores =
          [&] {
            return ViewScores{scores.individual, scores.global};
          },
      .predicted = predicted,
      .training_scores = scores,
      .frames = [&]() -> const std::vector<frame::TopFrame>& { return features.frames(run.config.sv_net.depth); }};
  const std::string best = run.config.sv_net.target == Target::global ? "opt_glob" : "opt_ind";
  for (const SelectorKind* kind :
       selectors_of_table({"svnet", "broadside", "phi_map", "top", "rand", best}, Split::training)) {
    char line[160];
    std::snprintf(line, sizeof line, "  %-10s %.3f  %s", kind->name,
                  mean_score(run, target, validated ? use.validate : use.learnt, kind->view(inputs, 1)), kind->help);
    lines.emplace_back(line);
  }
  return lines;
}

}  // namespace svnet::train
