#pragma once
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "train/evaluation.h"

namespace svnet::train {

/// Tables by split, "training" and "held_out".
using EvaluationTables = std::map<std::string, EvaluationTable>;

/// One line per pipeline and one column per selector, each with all metrics, as in the paper; then a line that says the
/// largest standard error; then, for each selector to compare with, how far SV-net is ahead of it, with 95 % intervals
/// over categories.
std::string table_text(const EvaluationTable& table, const std::string& title);

/// What the selectors of the tables and the metrics mean, one line each.
std::string columns_text(const EvaluationTables& tables);

/// {"format": 1, "problems", "tables": {split: {pipeline: {selector: {metric: {"mean", "standard_error", "low",
/// "high"}}}}}, "differences": {split: {pipeline: {"svnet-rand": {metric: {"mean", "low", "high"}}}}}}. "low" and
/// "high" are null if there are too few categories for an interval.
std::string tables_json(const EvaluationTables& tables);

/// {pipeline: {"svnet-rand": {metric: {"mean", "low", "high"}}}} of one table; empty if it does not have SV-net.
nlohmann::ordered_json differences_json(const EvaluationTable& table);

/// {pipeline: {selector: {metric: {"mean", "low", "high"}}}} of one table.
nlohmann::ordered_json intervals_json(const EvaluationTable& table);

}  // namespace svnet::train
