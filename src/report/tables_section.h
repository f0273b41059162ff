#pragma once
#include <string>

#include "report/run_report.h"

namespace svnet::report {

/// The tables of the evaluation with their plots, as markup; SV-net's lead comes first.
std::string tables_html(const RunReport& report);

/// Plots of SV-net's lead over other selectors, one per metric, as markup; nothing if the table has no leads.
std::string lead_plots_html(const Table& table);

}  // namespace svnet::report
