#pragma once
#include <span>
#include <string>
#include <vector>

#include "sorting/simulation.h"
#include "sorting/summary.h"

namespace svnet {

/// All that a simulation used and found.
struct SimulationReport {
  const ViewDataset& dataset;
  std::span<const train::Selector> selectors;
  std::span<const sorting::SortedTable> tables;
  std::span<const sorting::SelectorSummary> summaries;  ///< of each selector
  const sorting::SimulationOptions& options;
  std::string dataset_name, model, backbone, weights_sha256;  ///< model: empty, or its file
};

/// A line per selector: objects in wrong bins, moves and seconds of a table, and how many wrong objects fewer than with
/// the first selector.
std::string simulation_text(const SimulationReport& report);

/// The document of --json: what was simulated and by which rules, the means of each selector, and every table with its
/// wrong objects by selector.
std::string simulation_json(const SimulationReport& report);

}  // namespace svnet
