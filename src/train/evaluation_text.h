#pragma once
#include <map>
#include <string>

#include "train/evaluation.h"

namespace svnet::train {

/// Tables by split, "training" and "held_out".
using EvaluationTables = std::map<std::string, EvaluationTable>;

/// One line per pipeline and one column per selector, each with all metrics, as in the paper; the last line says the
/// largest standard error.
std::string table_text(const EvaluationTable& table, const std::string& title);

/// {"format": 1, "problems", "tables": {split: {pipeline: {selector: {metric: {"mean", "standard_error"}}}}}}.
std::string tables_json(const EvaluationTables& tables);

}  // namespace svnet::train
