#pragma once
#include <string>

#include "report/run_report.h"

namespace svnet::report {

/// The page of a run, as one HTML file (page.h).
std::string report_html(const RunReport& report);

}  // namespace svnet::report
