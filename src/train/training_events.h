#pragma once
#include <filesystem>
#include <string>

#include "io/events/event_file.h"

namespace svnet::train {

/// The columns of metrics.csv as scalars in TensorBoard, by epoch: "training/loss", "validation/spearman".
class TrainingEvents {
 public:
  /// Throws Error that names the file if it cannot be created. Events of an earlier training in the folder are removed.
  explicit TrainingEvents(const std::filesystem::path& run_folder);

  /// Adds the rows that were not added before. `metrics` are all rows so far, after the header of metrics.csv.
  void add(const std::string& metrics);

 private:
  io::EventFile file_;
  std::size_t rows_ = 0;
};

}  // namespace svnet::train
