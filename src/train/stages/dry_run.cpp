#include "train/stages/dry_run.h"

#include <algorithm>

#include "base/error.h"
#include "io/files/scratch_folder.h"
#include "train/stages/contact_sheet.h"
#include "train/stages/evaluation.h"
#include "train/stages/model.h"
#include "train/stages/predictions.h"
#include "train/stages/scores.h"

namespace svnet::train {
namespace {

/// The first `objects` objects of each category, in one pose, with its top view and three others.
ViewDataset sample_of(const ViewDataset& whole, Index objects) {
  constexpr Index kViews = 3;
  ViewDataset sample;
  sample.root = whole.root;
  sample.exif_orientation = whole.exif_orientation;
  sample.ignored = whole.ignored;
  sample.categories = whole.categories;
  std::vector<Index> objects_taken(whole.categories.size(), 0);
  Index last_object = -1;
  for (const auto& pose : whole.poses) {
    Index& taken = objects_taken[static_cast<std::size_t>(pose.category)];
    if (pose.object == last_object || taken == objects) continue;
    last_object = pose.object;
    ++taken;
    sample.objects.push_back(whole.objects[static_cast<std::size_t>(pose.object)]);
    ViewDataset::Pose part = pose;
    part.object = static_cast<Index>(sample.objects.size()) - 1;
    part.first_view = static_cast<Index>(sample.views.size());
    for (Index v = pose.first_view; v < pose.first_view + pose.view_count; ++v) {
      const bool top = v == pose.top_view;
      if (!top && static_cast<Index>(sample.views.size()) - part.first_view >= kViews) continue;
      View view = whole.views[static_cast<std::size_t>(v)];
      view.object = part.object;
      view.pose = static_cast<Index>(sample.poses.size());
      if (top) part.top_view = static_cast<Index>(sample.views.size());
      sample.views.push_back(view);
    }
    part.view_count = static_cast<Index>(sample.views.size()) - part.first_view;
    sample.poses.push_back(part);
  }
  return sample;
}

}  // namespace

void dry_run(const Config& config, const ViewDataset& dataset, const Messages& messages,
             const InferenceOptions& inference) {
  Config small = config;
  small.scores.problems = 100;
  small.scores.min_samples = 0;
  small.scores.target_error = 0;
  small.training.epochs = 1;
  const io::ScratchFolder folder("svnet-dry-run");
  const Run run = make_run(small, sample_of(dataset, std::max<Index>(2, config.scores.min_objects)), folder.path(),
                           messages, SingleProcess::shared(), inference);
  write_config(run);
  FeaturesStage features(run);
  const Scores scores = scores_stage(run, features);
  const Model model = model_stage(run, features, scores);
  const std::vector<double> predicted = predicted_scores(run, features, model);
  constexpr std::uint64_t kProblems = 10;
  const EvaluationInputs inputs{features, scores, predicted, nullptr, next_scores(run, features, model)};
  evaluation_stage(run, inputs, kProblems);
  contact_sheet_stage(run, inputs, kProblems);
}

}  // namespace svnet::train
