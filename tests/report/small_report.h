#pragma once
#include <cmath>

#include "report/run_report.h"

namespace svnet::report {

/// A report of a few made-up values: mugs and a category whose name is markup, held out of two pipelines.
inline RunReport small_report() {
  RunReport report;
  report.name = "demo";
  report.closed_form = true;
  report.target = "individual";
  report.training_categories = 3;
  report.held_out_categories = 2;
  report.settings = {{"Seed", "7"}, {"Dataset", "photos"}};
  Table table{.held_out = true,
              .pipelines = {"net_ward", "net_kmeans"},
              .selectors = {"top", "rand", "svnet"},
              .cells = {},
              .largest_standard_error = 0.002,
              .leads = {},
              .problems = 1000};
  train::PerMetric<Estimate> cell, lead;
  cell.fill({0.6, 0.5, 0.7});
  lead.fill({0.061, 0.035, 0.088});
  table.cells.assign(2, std::vector<train::PerMetric<Estimate>>(3, cell));
  table.leads = {{"rand", {lead, lead, lead}}};
  lead.fill({0.01, -0.02, 0.04});
  table.leads.push_back({"top", {lead, lead, lead}});
  report.tables = {table};
  for (const char* category : {"mug", "<b>\"pen\"</b>"})
    for (const char* object : {"1", "2", "3"}) {
      ShownPose pose{.category = category, .object = object, .pose = "1", .views = {}};
      pose.views = {
          {90, 90, 0.4, 0.48, 0.01}, {90, 45, 0.9, 0.61, 0.01}, {0, 60, 0.6, 0.66, 0.01}, {180, 45, 0.2, 0.31, 0.01}};
      pose.top = 0;
      pose.chosen = 1;
      pose.best = 2;
      pose.worst = 3;
      pose.mean_score = 0.515;
      pose.pictures = {{{"jpeg", 4, 4}, {"jpeg", 4, 4}, {"jpeg", 4, 4}}};
      if (std::string(object) != "2")
        pose.axis = frame::ObjectAxis{.kind = frame::AxisKind::found, .direction_deg = 30};
      report.poses.push_back(pose);
    }
  report.scores = {{true, {"mug", box_of({0.31, 0.48, 0.61, 0.66}), 0.61, 0.48}}};
  return report;
}

}  // namespace svnet::report
