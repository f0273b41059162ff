#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "report/run_report.h"
#include "train/config/config.h"

namespace svnet::report {

/// A run of a comparison.
struct ComparedRun {
  std::string name;
  std::vector<Setting> settings;  ///< every key of its configuration; the same keys in every run
  std::vector<Table> tables;
  std::optional<TrainingCurves> curves;
};

/// Reads what a comparison needs of a run folder: its tables, its curves and its configuration. Throws Error that names
/// a file that is missing or damaged.
ComparedRun read_compared_run(const std::filesystem::path& folder);

/// Gives runs whose folders have the same name the folders' paths for names. Requires as many folders as runs.
void name_apart(std::vector<ComparedRun>& runs, const std::vector<std::filesystem::path>& folders);

/// A table with a line for each key whose values differ, with its name and the value in each run.
std::vector<std::vector<std::string>> differing_settings(const std::vector<ComparedRun>& runs);

/// The runs side by side as one HTML file: settings that differ, tables and plots with a row per run, curves overlaid.
/// Requires a run.
std::string comparison_html(const std::vector<ComparedRun>& runs);

}  // namespace svnet::report
