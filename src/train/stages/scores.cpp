#include "train/stages/scores.h"

#include <algorithm>
#include <chrono>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text.h"
#include "semantics/semantic_scores.h"
#include "train/config/fingerprint.h"
#include "train/random_problems.h"
#include "train/stages/options.h"
#include "train/stages/reuse_or_make.h"

namespace svnet::train {
using semantics::ScoreSums;

namespace {

/// Puts the work of a snapshot into `sums`. Throws Error if `path` is no snapshot, or if it is one of other scores and
/// Resume is any; one of other scores is ignored if Resume is same.
void take_snapshot(const std::filesystem::path& path, const std::string& fingerprint, Resume how, ScoreSums& sums) {
  const io::ScoresSnapshot snapshot = io::read_scores_snapshot(path);
  if (how == Resume::same && snapshot.input_fingerprint != fingerprint) return;
  check(snapshot.input_fingerprint == fingerprint, path.string(),
        ": a snapshot of other scores (other features, options or seed); repeat the command that made it, or leave out "
        "--resume");
  const auto values = sums.values();
  const auto views = static_cast<Index>(sums.views.size());
  check(snapshot.views == views && snapshot.sums.size() == values.size(), path.string(), ": dataset 'sums': has ",
        snapshot.sums.size(), " numbers of ", snapshot.views, " views, expected ", values.size(), " of ", views);
  std::copy(snapshot.sums.begin(), snapshot.sums.end(), values.begin());
  sums.problems = static_cast<std::uint64_t>(snapshot.problems);
}

/// The sums to continue from, in every process: those of the snapshot, which the root process reads, or zeros.
ScoreSums first_sums(const std::filesystem::path& path, const std::string& fingerprint, Index views,
                     const Messages& messages, const ScoringOptions& options) {
  ScoreSums sums(views);
  if (options.resume == Resume::never) return sums;
  if (options.communicator.is_root() && std::filesystem::exists(path)) try {
      take_snapshot(path, fingerprint, options.resume, sums);
    } catch (const Error& error) {
      if (options.resume == Resume::any) throw;
      if (messages.line) messages.line(joined("made again: ", error.what()));
    }
  sums.problems = options.communicator.broadcast(sums.problems);
  if (sums.problems == 0) return sums;
  options.communicator.all_reduce(sums.values());
  if (messages.line) messages.line(joined("resumed after ", sums.problems, " problems"));
  return sums;
}

/// Writes a snapshot each time that the last one is old enough; none if the path is empty.
class Snapshots {
 public:
  Snapshots(const std::filesystem::path& path, double seconds, const std::string& fingerprint)
      : path_(path), seconds_(seconds), fingerprint_(fingerprint), last_(Clock::now()) {}

  void write_if_due(const ScoreSums& sums) {
    if (path_.empty() || std::chrono::duration<double>(Clock::now() - last_).count() < seconds_) return;
    const auto values = sums.values();
    io::write_scores_snapshot(path_, {fingerprint_,
                                      static_cast<Index>(sums.problems),
                                      static_cast<Index>(sums.views.size()),
                                      {values.begin(), values.end()}});
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

Scores make_scores(const std::filesystem::path& path, const ViewDataset& dataset, const Features& features,
                   const std::vector<bool>& excluded, const Config& config, const Messages& messages,
                   const ScoringOptions& how) {
  Config::Scores drawn = config.scores;
  drawn.min_categories = fewest_categories(excluded, drawn);
  const semantics::DistanceMatrix distances = semantics::squared_distances(
      features.values.data(), features.count, features.dimension, Parallel::shared(), how.communicator);
  const semantics::ClusteringProblems problems = clustering_problems(dataset, excluded, drawn);
  const semantics::ScoreOptions options = score_options(config, features.dimension);
  const std::string fingerprint = scores_fingerprint(features.input_fingerprint, config);

  const std::filesystem::path snapshot = io::snapshot_path(path);
  ScoreSums sums = first_sums(snapshot, fingerprint, problems.views(), messages, how);
  Snapshots snapshots(how.communicator.is_root() ? snapshot : std::filesystem::path(), how.snapshot_seconds,
                      fingerprint);
  continue_scores(distances, problems, options, Parallel::shared(), how.communicator, sums,
                  {&messages, [&](const ScoreSums& so_far) { snapshots.write_if_due(so_far); }});
  semantics::SemanticScores made = scores_from(sums);

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
  scores.scaled = semantics::scaled_per_pose(scores.individual, problems.pose_of_view());
  return scores;
}

void write_made_scores(const std::filesystem::path& path, const Scores& scores) {
  io::write_scores(path, scores);
  std::error_code no_snapshot;
  std::filesystem::remove(io::snapshot_path(path), no_snapshot);
}

Scores scores_stage(const Run& run, FeaturesStage& features_stage) {
  const Config& config = run.config;
  const Features& features = features_stage.features(config.scores.backbone, config.scores.layer);
  const StageFile file{.path = run.folder / "scores.h5",
                       .fingerprint = scores_fingerprint(features.input_fingerprint, config),
                       .content = "scores"};
  const auto make = [&] {
    return make_scores(file.path, run.dataset, features, run.held_out, config, run.messages,
                       {.resume = Resume::same, .communicator = run.communicator});
  };
  return reuse_or_make(run, file, io::read_scores, make, write_made_scores);
}

}  // namespace svnet::train
