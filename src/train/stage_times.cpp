#include "train/stage_times.h"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "io/files/atomic_file.h"
#include "io/files/whole_file.h"

namespace svnet::train {
namespace fs = std::filesystem;

namespace {

constexpr const char* kHeader = "stage,seconds,reused";
constexpr const char* kFile = "timings.csv";

std::vector<StageTime> read_file(const fs::path& file) {
  std::vector<StageTime> times;
  if (!fs::exists(file)) return times;
  std::istringstream text(io::whole_file(file));
  std::string line;
  check(std::getline(text, line) && line == kHeader, file.string(), ": line 1: expected ", kHeader);
  for (std::size_t number = 2; std::getline(text, line); ++number) {
    const std::size_t last = line.rfind(','), first = last == std::string::npos ? last : line.rfind(',', last - 1);
    StageTime time;
    check(first != std::string::npos && parse_number(line.substr(first + 1, last - first - 1), time.seconds) &&
              (line.substr(last) == ",0" || line.substr(last) == ",1"),
          file.string(), ": line ", number, ": expected a stage, its seconds, and 0 or 1; remove the file to go on");
    time.stage = line.substr(0, first);
    time.reused = line.back() == '1';
    times.push_back(std::move(time));
  }
  return times;
}

StageTime* find(std::vector<StageTime>& times, const std::string& stage) {
  const auto found = std::ranges::find(times, stage, &StageTime::stage);
  return found == times.end() ? nullptr : &*found;
}

void write_file(const fs::path& file, const std::vector<StageTime>& times) {
  std::ostringstream text;
  text << kHeader << '\n';
  for (const StageTime& time : times) text << time.stage << ',' << time.seconds << ',' << time.reused << '\n';
  io::write_atomically(file, text.str());
}

/// The run's folder, then those of its folds and rounds, each with theirs.
std::vector<fs::path> folders_of(const fs::path& folder) {
  std::vector<fs::path> all{folder}, inside;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory() && (name.starts_with("fold-") || name.starts_with("round-"))) inside.push_back(entry);
  }
  std::ranges::sort(inside, [](const fs::path& a, const fs::path& b) { return natural_less(a.string(), b.string()); });
  for (const fs::path& other : inside) std::ranges::copy(folders_of(other), std::back_inserter(all));
  return all;
}

}  // namespace

StageTimer::StageTimer(const Run& run, std::string stage) : run_(run), stage_(std::move(stage)) {
  std::erase(stage_, ',');
  inner_before_ = std::exchange(run.clock->inner_seconds, 0);
}

StageTimer::~StageTimer() {
  run_.clock->inner_seconds = inner_before_ + std::chrono::duration<double>(Clock::now() - start_).count();
}

double StageTimer::own_seconds() const {
  return std::chrono::duration<double>(Clock::now() - start_).count() - run_.clock->inner_seconds;
}

void StageTimer::made() {
  if (!run_.communicator.is_root()) return;
  const fs::path file = run_.folder / kFile;
  std::vector<StageTime> times = read_file(file);
  std::erase_if(times, [&](const StageTime& time) { return time.stage == stage_; });
  times.push_back({stage_, own_seconds(), false});
  write_file(file, times);
}

void StageTimer::reused() {
  if (!run_.communicator.is_root()) return;
  const fs::path file = run_.folder / kFile;
  std::vector<StageTime> times = read_file(file);
  StageTime* const made_before = find(times, stage_);
  if (made_before == nullptr || made_before->reused) return;
  made_before->reused = true;
  write_file(file, times);
}

std::vector<StageTime> read_stage_times(const fs::path& run_folder) {
  std::vector<StageTime> sums;
  for (const fs::path& folder : folders_of(run_folder))
    for (const StageTime& time : read_file(folder / kFile)) {
      StageTime* const sum = find(sums, time.stage);
      if (sum == nullptr) {
        sums.push_back(time);
        continue;
      }
      sum->seconds += time.seconds;
      sum->reused = sum->reused && time.reused;
    }
  return sums;
}

}  // namespace svnet::train
