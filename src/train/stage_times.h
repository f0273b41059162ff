#pragma once
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "train/run.h"

namespace svnet::train {

/// How long a stage took, without the stages that it started.
struct StageTime {
  std::string stage;    ///< "features of mobilenet_v2"
  double seconds = 0;   ///< when it was made
  bool reused = false;  ///< whether the last command found it made
};

/// Measures a stage from its construction on. The root process writes the time into timings.csv of the run folder.
class StageTimer {
 public:
  StageTimer(const Run& run, std::string stage);
  ~StageTimer();
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

  /// The stage was made. Replaces the time of an earlier run.
  void made();
  /// The stage was found made. Keeps the time of the run that made it.
  void reused();

 private:
  using Clock = std::chrono::steady_clock;
  /// Without the stages that began and ended since the construction.
  double own_seconds() const;

  const Run& run_;
  std::string stage_;
  Clock::time_point start_ = Clock::now();
  double inner_before_;  // of the stage around this one
};

/// The times in timings.csv of a run folder and of the folders of its folds and rounds, in the order of the stages'
/// first ends. Times of one stage in several folders are added; it counts as reused if all of them are. Empty if there
/// is no such file. Throws Error that names a file that is damaged.
std::vector<StageTime> read_stage_times(const std::filesystem::path& run_folder);

}  // namespace svnet::train
