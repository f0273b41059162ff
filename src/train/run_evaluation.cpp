#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <map>
#include <system_error>

#include "base/parallel.h"
#include "io/files/atomic_file.h"
#include "io/images/image_file.h"
#include "train/contact_sheet.h"
#include "train/run.h"
#include "train/scores_stage.h"

namespace svnet {
namespace {

/// The first `objects` objects of each category, in one pose, by their top view and three others.
ViewDataset sample_of(const ViewDataset& whole, Index objects) {
  constexpr Index kViews = 3;
  ViewDataset sample;
  sample.root = whole.root;
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

/// A folder of its own under the system's folder for temporary files, removed in the end.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::error_code error;
    const auto temporary = std::filesystem::temp_directory_path(error);
    const char* given = std::getenv("TMPDIR");
    check(!error, given != nullptr ? given : "/tmp", ": is no folder for temporary files; set TMPDIR to one");
    std::string name = (temporary / "svnet-dry-run-XXXXXX").string();
    check(mkdtemp(name.data()) != nullptr, temporary.string(),
          ": no temporary folder can be made in it: ", std::generic_category().message(errno),
          "; set TMPDIR to another one");
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace

EvaluationTables Run::evaluation(std::uint64_t problem_count, const std::optional<std::filesystem::path>& json) {
  const std::vector<double>& predicted = predictions();
  const Scores& scores = this->scores();

  std::map<std::string, std::pair<DistanceMatrix, Index>> distances;  // of each backbone, with its features' dimension
  std::vector<EvaluationPipeline> pipelines;
  for (const auto& name : config_.evaluation.pipelines) {
    const PipelineName parsed = parse_pipeline(name, "evaluation.pipelines");
    auto found = distances.find(parsed.backbone);
    if (found == distances.end()) {
      const Features& f =
          features(parsed.backbone, parsed.backbone == config_.scores.backbone ? config_.scores.layer : std::string());
      found = distances
                  .emplace(parsed.backbone,
                           std::pair(squared_distances(f.values.data(), f.count, f.dimension, Parallel::shared()),
                                     f.dimension))
                  .first;
    }
    pipelines.push_back({name, &found->second.first, {.method = parsed.clustering, .dimension = found->second.second}});
  }

  const EvaluationOptions options{
      .problems = problem_count, .seed = static_cast<std::uint64_t>(config_.seed), .nmi = config_.evaluation.nmi};
  std::vector<bool> trained_on = held_out_;
  trained_on.flip();
  EvaluationTables tables;
  tables["training"] =
      evaluate(dataset_, clustering_problems(dataset_, held_out_, config_.scores), pipelines,
               {top_selector(dataset_), random_selector(), best_selector("opt_glob", dataset_, scores.global),
                best_selector("opt_ind", dataset_, scores.individual)},
               options, Parallel::shared(), messages_, "evaluation, training categories");
  if (std::count(held_out_.begin(), held_out_.end(), true) >= 2)
    tables["held_out"] =
        evaluate(dataset_, clustering_problems(dataset_, trained_on, config_.scores), pipelines,
                 {top_selector(dataset_), random_selector(), best_selector("svnet", dataset_, predicted)}, options,
                 Parallel::shared(), messages_, "evaluation, held-out categories");
  else
    say("evaluation: fewer than 2 held-out categories, no table of them");
  write_atomically(folder_ / "evaluation.json", tables_json(tables));
  if (json) write_atomically(*json, tables_json(tables));
  return tables;
}

std::optional<std::filesystem::path> Run::contact_sheet(std::uint64_t problem_count) {
  if (std::count(held_out_.begin(), held_out_.end(), true) < 2) return {};
  const std::vector<double>& predicted = predictions();
  std::vector<bool> trained_on = held_out_;
  trained_on.flip();
  const Features& of_views = features(config_.scores.backbone, config_.scores.layer);
  ScoreOptions options = score_options(config_, of_views.dimension);
  options.problems = problem_count;
  options.min_samples = 0;
  options.target_error = 0;
  const SemanticScores scores = semantic_scores(
      squared_distances(of_views.values.data(), of_views.count, of_views.dimension, Parallel::shared()),
      clustering_problems(dataset_, trained_on, config_.scores), options, Parallel::shared(), messages_);
  const auto& best = config_.sv_net.target == Target::individual ? scores.individual : scores.global;
  const Selector selectors[] = {top_selector(dataset_), best_selector("svnet", dataset_, predicted),
                                best_selector("best", dataset_, best)};
  const auto path = folder_ / "views.png";
  write_png(path, svnet::contact_sheet(dataset_, sheet_poses(dataset_, held_out_), selectors));
  return path;
}

void dry_run(const Config& config, const ViewDataset& dataset, const Messages& messages) {
  Config small = config;
  small.scores.problems = 100;
  small.scores.min_samples = 0;
  small.scores.target_error = 0;
  small.training.epochs = 1;
  const ScratchFolder folder;
  Run run(small, sample_of(dataset, std::max<Index>(2, config.scores.min_objects)), folder.path(), messages);
  run.model();
  run.evaluation(10);
  run.contact_sheet(10);
}

}  // namespace svnet
