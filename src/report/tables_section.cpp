#include "report/tables_section.h"

#include <algorithm>

#include "base/error.h"
#include "base/text.h"
#include "report/dot_plot.h"
#include "report/line_chart.h"
#include "report/markup.h"
#include "report/names.h"
#include "report/page.h"
#include "report/summary.h"

namespace svnet::report {
namespace {

constexpr std::size_t kMostOpenFolds = 12;

std::string figure(const std::string& svg_markup) {
  return svg_markup.empty() ? "" : element("figure", svg_markup) + "\n";
}

std::string row_label(const Table& table, std::size_t row) {
  return row < table.pipelines.size() ? table.pipelines[row] : "mean";
}

DotPlot lead_plot(const Table& table, std::size_t metric) {
  DotPlot plot{.title = train::kMetrics[metric].title,
               .alternative = "SV-net minus other selectors, with 95 % intervals",
               .rows = {},
               .differences = true};
  for (const Table::Lead& lead : table.leads) {
    if (lead.rows.size() > 1) plot.rows.push_back({.label = "over the " + selector_label(lead.over)});
    for (std::size_t row = 0; row < lead.rows.size(); ++row)
      plot.rows.push_back({.label = lead.rows.size() > 1 ? row_label(table, row) : "over " + selector_label(lead.over),
                           .value = lead.rows[row][metric],
                           .stands_out = row + 1 == lead.rows.size()});
  }
  return plot;
}

DotPlot level_plot(const Table& table, std::size_t metric) {
  DotPlot plot{.title = train::kMetrics[metric].title,
               .alternative = "Means of selectors, with 95 % intervals",
               .rows = {},
               .differences = false};
  for (std::size_t p = 0; p < table.pipelines.size(); ++p) {
    plot.rows.push_back({.label = table.pipelines[p]});
    for (std::size_t s = 0; s < table.selectors.size(); ++s)
      plot.rows.push_back({.label = selector_label(table.selectors[s]),
                           .value = table.cells[p][s][metric],
                           .stands_out = table.selectors[s] == "svnet"});
  }
  return plot;
}

std::string cell(const Estimate& estimate) {
  std::string inner = escaped(number(estimate.mean));
  if (estimate.has_interval())
    inner += element("small", escaped(number(estimate.low) + " to " + number(estimate.high)));
  return element("td", inner);
}

std::string means_html(const Table& table) {
  std::string head = element("th", {{"scope", "col"}}, "Selector"), body;
  for (const train::Metric& metric : train::kMetrics) head += element("th", {{"scope", "col"}}, escaped(metric.title));
  for (std::size_t p = 0; p < table.pipelines.size(); ++p) {
    body += element("tr", {{"class", "group"}},
                    element("th", {{"scope", "rowgroup"}, {"colspan", std::to_string(train::kMetrics.size() + 1)}},
                            escaped(table.pipelines[p])));
    for (std::size_t s = 0; s < table.selectors.size(); ++s) {
      std::string row = element("th", {{"scope", "row"}}, escaped(selector_label(table.selectors[s])));
      for (const Estimate& estimate : table.cells[p][s]) row += cell(estimate);
      body += element("tr", table.selectors[s] == "svnet" ? Attributes{{"class", "svnet"}} : Attributes{}, row);
    }
  }
  const std::string caption = joined("Means over ", table.problems, " problems, each with at most ",
                                     number(table.largest_standard_error, 4), " standard error over problems");
  return table_html(
      table.held_out ? "Means of held-out categories" : "Means of training categories",
      element("caption", escaped(caption)) + element("thead", element("tr", head)) + element("tbody", body));
}

std::string folds_html(const RunReport& report) {
  if (report.folds.empty()) return "";
  std::string body;
  for (const FoldFigures& fold : report.folds) {
    const train::WithinPose& w = fold.within_pose;
    body +=
        element("tr", element("th", {{"scope", "row"}}, escaped(joined_with(", ", fold.held_out))) +
                          element("td", escaped(number(w.spearman, 2))) + element("td", escaped(number(w.regret, 3))) +
                          element("td", escaped(number(100 * w.better_than_top, 0) + " %")) +
                          element("td", escaped(number(100 * w.better_than_rand, 0) + " %")));
  }
  std::string head;
  for (const char* title : {"Held out", "Spearman", "Regret", "Better than top", "Better than random"})
    head += element("th", {{"scope", "col"}}, title);
  std::string table = table_html("Figures of folds", element("thead", element("tr", head)) + element("tbody", body));
  if (report.folds.size() > kMostOpenFolds)
    table = element("details", element("summary", escaped(joined(report.folds.size(), " folds"))) + table) + "\n";
  return element("h3", "Fold by fold") + "\n" +
         how_to_read(
             "Each line is about categories that were held out together. Spearman says how well predicted scores order "
             "the views of a pose (1: as the true scores), regret how far the chosen view is below the best one.") +
         table;
}

/// What moving the camera in a share of the poses gives: a line per pipeline; nothing unless the table has the
/// selectors.
std::string moves_html(const Table& table) {
  std::vector<std::size_t> steps;
  for (const char* name : {"top", "move_25", "move_50", "move_75", "svnet"}) {
    const auto at = std::find(table.selectors.begin(), table.selectors.end(), name);
    if (at == table.selectors.end()) return "";
    steps.push_back(static_cast<std::size_t>(at - table.selectors.begin()));
  }
  std::string plots;
  for (std::size_t metric = 0; metric < train::kMetrics.size(); ++metric) {
    LineChart chart{.title = train::kMetrics[metric].title,
                    .lines = {},
                    .first = "0 % moved",
                    .last = "100 %",
                    .along = "by the share of poses in which the camera moved",
                    .long_labels = true};
    for (std::size_t p = 0; p < table.pipelines.size(); ++p) {
      Line line{table.pipelines[p], {}};
      for (const std::size_t step : steps) line.values.push_back(table.cells[p][step][metric].mean);
      chart.lines.push_back(std::move(line));
    }
    plots += figure(line_chart(chart));
  }
  return element("h4", "Moving only where it pays") + "\n" +
         how_to_read(
             "The camera stays above, or moves to SV-net's view where SV-net expects most of it: from no pose on the "
             "left to all of them on the right, in steps of a quarter. A line that rises fast on the left says that "
             "few moves give most of what all give; a line that sags says that views from above and from the side do "
             "not mix well.") +
         element("div", {{"class", "plots"}}, "\n" + plots) + "\n";
}

std::string table_section(const Table& table) {
  std::string html = element("h3", table.held_out ? "Held-out categories" : "Training categories") + "\n";
  if (const std::string leads = lead_plots_html(table); !leads.empty())
    html += how_to_read(
                "SV-net minus another selector, in the same problems: to the right of the line at 0, SV-net is better. "
                "A bar is the 95 % interval over categories; a hollow dot means that the interval includes 0, or that "
                "there is none, so the difference is not sure.") +
            leads;
  html += how_to_read(joined(
      "Each selector chooses one view per object, and the views are clustered; 1 is the best value. ",
      table.held_out ? "SV-net never saw these categories. "
                     : "The scores and SV-net were made with these categories. ",
      "Small figures are 95 % intervals over categories: they are wide because some categories are harder than others, "
      "and the differences between selectors are surer than they look."));
  html += means_html(table);
  std::string plots;
  for (std::size_t metric = 0; metric < train::kMetrics.size(); ++metric)
    plots += figure(dot_plot(level_plot(table, metric)));
  return html + element("div", {{"class", "plots"}}, "\n" + plots) + "\n" + moves_html(table);
}

}  // namespace

std::string lead_plots_html(const Table& table) {
  std::string plots;
  for (std::size_t metric = 0; metric < train::kMetrics.size(); ++metric)
    plots += figure(dot_plot(lead_plot(table, metric)));
  return plots.empty() ? "" : element("div", {{"class", "plots"}}, "\n" + plots) + "\n";
}

std::string tables_html(const RunReport& report) {
  std::string html;
  for (const Table& table : report.tables) html += table_section(table);
  return html + folds_html(report);
}

}  // namespace svnet::report
