#include "train/scores_stage.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"
#include "base/sha256.h"
#include "base/text.h"

namespace svnet {
namespace {

/// Where fewer categories take part than a problem may have, all of them are in every problem.
Index fewest_categories(const std::vector<bool>& excluded, const Config::Scores& s) {
  return std::min(s.min_categories, static_cast<Index>(std::count(excluded.begin(), excluded.end(), false)));
}

std::string sampler_text(const Config::Scores& s) {
  const auto bound = [](Index value) { return value == 0 ? std::string("all") : std::to_string(value); };
  return joined("uniform; categories ", s.min_categories, " to ", bound(s.max_categories), ", objects ", s.min_objects,
                " to ", bound(s.max_objects), ", one pose, one view; singletons ", name_of(s.singletons));
}

}  // namespace

ClusteringProblems clustering_problems(const ViewDataset& dataset, const std::vector<bool>& excluded,
                                       const Config::Scores& config) {
  std::vector<std::int64_t> category, object, pose, excluded_numbers;
  for (const View& view : dataset.views) {
    category.push_back(view.category);
    object.push_back(view.object);
    pose.push_back(view.pose);
  }
  for (std::size_t c = 0; c < excluded.size(); ++c)
    if (excluded[c]) excluded_numbers.push_back(static_cast<std::int64_t>(c));
  std::vector<Index> objects(dataset.categories.size(), 0);
  for (const auto& each : dataset.objects) ++objects[static_cast<std::size_t>(each.category)];
  for (std::size_t c = 0; c < objects.size(); ++c)
    check(excluded[c] || objects[c] >= config.min_objects, "category '", dataset.categories[c], "' has ", objects[c],
          " objects, fewer than min_objects, ", config.min_objects, "; lower it, or leave the category out");
  return {category, object, pose,
          ProblemOptions{.min_categories = fewest_categories(excluded, config),
                         .max_categories = config.max_categories,
                         .min_objects = config.min_objects,
                         .max_objects = config.max_objects,
                         .excluded_categories = excluded_numbers}};
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

namespace {

/// Puts the work of a snapshot into `sums`. A snapshot of other scores is refused or, where `only_same`, left alone.
void resume(const std::filesystem::path& path, const std::string& fingerprint, bool only_same, ScoreSums& sums) {
  const ScoresSnapshot snapshot = read_scores_snapshot(path);
  if (only_same && snapshot.input_fingerprint != fingerprint) return;
  check(snapshot.input_fingerprint == fingerprint, path.string(),
        ": a snapshot of other scores (other features, options or seed); repeat the command that made it, or leave out "
        "--resume");
  const auto numbers = sums.numbers();
  const auto views = static_cast<Index>(sums.views.size());
  check(snapshot.views == views && snapshot.sums.size() == numbers.size(), path.string(), ": dataset 'sums': has ",
        snapshot.sums.size(), " numbers of ", snapshot.views, " views, expected ", numbers.size(), " of ", views);
  std::copy(snapshot.sums.begin(), snapshot.sums.end(), numbers.begin());
  sums.problems = static_cast<std::uint64_t>(snapshot.problems);
}

/// What the communicator goes on from: what its first process finds in a snapshot, or nothing.
ScoreSums first_sums(const std::filesystem::path& path, const std::string& fingerprint, Index views,
                     const Messages& messages, const ScoresRun& run) {
  using Resume = ScoresRun::Resume;
  ScoreSums sums(views);
  if (run.resume == Resume::never) return sums;
  if (run.communicator.is_root() && std::filesystem::exists(path)) try {
      resume(path, fingerprint, run.resume == Resume::same, sums);
    } catch (const Error& error) {
      if (run.resume == Resume::any) throw;
      if (messages.line) messages.line(joined("made again: ", error.what()));
    }
  sums.problems = run.communicator.broadcast(sums.problems);
  if (sums.problems == 0) return sums;
  run.communicator.all_reduce(sums.numbers());
  if (messages.line) messages.line(joined("resumed after ", sums.problems, " problems"));
  return sums;
}

/// Writes a snapshot when the last one is old enough.
class Snapshots {
 public:
  Snapshots(const std::filesystem::path& path, double seconds, const std::string& fingerprint)
      : path_(path), seconds_(seconds), fingerprint_(fingerprint), last_(Clock::now()) {}

  void offer(const ScoreSums& sums) {
    if (path_.empty() || std::chrono::duration<double>(Clock::now() - last_).count() < seconds_) return;
    const auto numbers = sums.numbers();
    write_scores_snapshot(path_, {fingerprint_,
                                  static_cast<Index>(sums.problems),
                                  static_cast<Index>(sums.views.size()),
                                  {numbers.begin(), numbers.end()}});
    last_ = Clock::now();
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::filesystem::path path_;
  double seconds_;
  std::string fingerprint_;
  Clock::time_point last_;
};

}  // namespace

ScoreOptions score_options(const Config& config, Index dimension) {
  const auto& s = config.scores;
  return {.problems = static_cast<std::uint64_t>(s.problems),
          .min_samples = static_cast<std::uint64_t>(s.min_samples),
          .target_error = s.target_error,
          .seed = static_cast<std::uint64_t>(config.seed),
          .singletons = s.singletons,
          .clustering = {.method = s.clustering, .dimension = dimension}};
}

Scores make_scores(const std::filesystem::path& path, const ViewDataset& dataset, const Features& features,
                   const std::vector<bool>& excluded, const Config& config, const Messages& messages,
                   const ScoresRun& run) {
  Config::Scores drawn = config.scores;
  drawn.min_categories = fewest_categories(excluded, drawn);
  const DistanceMatrix distances = squared_distances(features.values.data(), features.count, features.dimension,
                                                     Parallel::shared(), run.communicator);
  const ClusteringProblems problems = clustering_problems(dataset, excluded, drawn);
  const ScoreOptions options = score_options(config, features.dimension);
  const std::string fingerprint = scores_fingerprint(features.input_fingerprint, config);

  const std::filesystem::path snapshot = snapshot_path(path);
  ScoreSums sums = first_sums(snapshot, fingerprint, problems.views(), messages, run);
  Snapshots snapshots(run.communicator.is_root() ? snapshot : std::filesystem::path(), run.snapshot_seconds,
                      fingerprint);
  continue_scores(distances, problems, options, Parallel::shared(), run.communicator, sums,
                  {&messages, [&](const ScoreSums& so_far) { snapshots.offer(so_far); }});
  SemanticScores made = scores_from(sums);

  Scores scores{ScoresOrigin{.problems = static_cast<Index>(made.problems),
                             .seed = options.seed,
                             .sampler = sampler_text(drawn),
                             .clustering = name_of(drawn.clustering),
                             .metric = "fm",
                             .input_fingerprint = fingerprint},
                std::move(made.individual),
                std::move(made.global),
                {},
                std::move(made.count),
                std::move(made.standard_error),
                rank_stability(sums, problems.pose_of_view()),
                features.paths};
  scores.scaled = scaled_per_pose(scores.individual, problems.pose_of_view());
  if (run.communicator.is_root()) {
    write_scores(path, scores);
    std::error_code no_snapshot;
    std::filesystem::remove(snapshot, no_snapshot);
  }
  return scores;
}

ScoresSummary summary(const Scores& scores) {
  ScoresSummary s;
  double error_sum = 0, scored = 0, stability_sum = 0, ranked = 0;
  for (std::size_t v = 0; v < scores.paths.size(); ++v) {
    s.most = std::max(s.most, scores.count[v]);
    if (scores.count[v] == 0)
      ++s.left_out;
    else
      s.fewest = std::min(s.fewest, scores.count[v]);
    if (std::isfinite(scores.standard_error[v])) {
      s.largest_error = std::max(s.largest_error, scores.standard_error[v]);
      error_sum += scores.standard_error[v];
      ++scored;
    }
    if (std::isfinite(scores.rank_stability[v])) {
      stability_sum += scores.rank_stability[v];
      ++ranked;
    }
  }
  s.mean_error = error_sum / scored;
  s.mean_stability = stability_sum / ranked;
  return s;
}

std::string certainty_text(const Scores& scores) {
  const ScoresSummary s = summary(scores);
  if (std::isnan(s.mean_error)) return "too few problems to say how well the scores are known";
  std::string text = joined("every view was in at least ", s.fewest, " problems; standard error ", std::setprecision(2),
                            s.mean_error, " on average, ", s.largest_error, " at most");
  if (!std::isnan(s.mean_stability))
    text += joined("\nrank stability of the views of a pose (Kendall's tau between halves of the problems): ",
                   std::setprecision(3), s.mean_stability, " on average");
  return text;
}

}  // namespace svnet
