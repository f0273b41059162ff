#pragma once
#include <string>

#include "report/names.h"
#include "report/run_report.h"

namespace svnet::report {

/// Figures of the poses whose axis was measured: the top view, the chosen view and the best one, and maps of predicted
/// and true scores, as markup. The id of the first figure of an object is "category-object".
std::string pose_figures_html(const RunReport& report, Ids& ids);

/// A line per held-out pose, folded by category, as markup. Objects without a figure get their id here. Requires that
/// `ids` made the ids of the figures.
std::string pose_table_html(const RunReport& report, Ids& ids);

}  // namespace svnet::report
