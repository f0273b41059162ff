#include "train/stages/resumed_sums.h"

#include <algorithm>
#include <chrono>

#include "base/error.h"
#include "base/text.h"
#include "io/files/snapshot_path.h"
#include "io/views/scores_file.h"

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
    if (std::chrono::duration<double>(Clock::now() - last_).count() >= seconds_) write(sums);
  }

  void write(const ScoreSums& sums) {
    if (path_.empty()) return;
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

ScoreSums resumed_sums(const std::filesystem::path& path, const std::string& fingerprint, Index views,
                       const Messages& messages, const ScoringOptions& how, const AddProblems& add) {
  const std::filesystem::path snapshot = io::snapshot_path(path);
  ScoreSums sums = first_sums(snapshot, fingerprint, views, messages, how);
  Snapshots snapshots(how.communicator.is_root() ? snapshot : std::filesystem::path(), how.snapshot_seconds,
                      fingerprint);
  try {
    add(sums, {&messages, [&](const ScoreSums& so_far) { snapshots.write_if_due(so_far); }});
  } catch (...) {
    snapshots.write(sums);  // the program is told to end, or something failed: the sums hold whole problems
    throw;
  }
  return sums;
}

}  // namespace svnet::train
