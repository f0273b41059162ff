#include "report/write_report.h"

#include "report/learning_sections.h"
#include "report/names.h"
#include "report/page.h"
#include "report/poses_section.h"
#include "report/summary.h"
#include "report/tables_section.h"

namespace svnet::report {

std::string report_html(const RunReport& report) {
  Ids ids;
  const std::string figures = pose_figures_html(report, ids);  // before the table, which names the objects left
  Page page{.title = "Views that SV-net chose: " + report.name, .lead = summary_html(report), .sections = {}};
  page.sections = {{"results", "Results", tables_html(report)},
                   {"poses", "Poses in detail", figures},
                   {"objects", "Every held-out object", pose_table_html(report, ids)},
                   {"training", "Training", training_html(report)},
                   {"scores", "Scores by category", scores_html(report)},
                   {"features", "Map of features", map_html(report)},
                   {"times", "Time per stage", times_html(report)}};
  return page_html(page);
}

}  // namespace svnet::report
