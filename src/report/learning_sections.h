#pragma once
#include <string>

#include "report/run_report.h"

// The sections on training, scores, features and times, as markup. A section is empty if its figures are not known.
namespace svnet::report {

/// Curves of the training, or why there are none.
std::string training_html(const RunReport& report);

/// How the scores of each category are distributed.
std::string scores_html(const RunReport& report);

/// Maps of the features of top views and of chosen views.
std::string map_html(const RunReport& report);

/// The time of each stage.
std::string times_html(const RunReport& report);

}  // namespace svnet::report
