#include "report/comparison.h"

#include <algorithm>
#include <map>

#include "base/error.h"
#include "base/text.h"
#include "report/dot_plot.h"
#include "report/line_chart.h"
#include "report/markup.h"
#include "report/names.h"
#include "report/page.h"
#include "report/stored_results.h"
#include "report/summary.h"
#include "train/config/config_file.h"
#include "train/config/config_table.h"

namespace svnet::report {
namespace {

namespace fs = std::filesystem;

std::string plots(const std::vector<std::string>& figures) {
  std::string inner;
  for (const std::string& figure : figures)
    if (!figure.empty()) inner += element("figure", figure) + "\n";
  return inner.empty() ? "" : element("div", {{"class", "plots"}}, "\n" + inner) + "\n";
}

const Table* table_of(const ComparedRun& run, bool held_out) {
  for (const Table& table : run.tables)
    if (table.held_out == held_out) return &table;
  return nullptr;
}

/// The mean over the pipelines of a table; without an interval if there are several.
Estimate mean_over_pipelines(const Table& table, std::size_t selector, std::size_t metric) {
  if (table.pipelines.size() == 1) return table.cells[0][selector][metric];
  double sum = 0;
  for (const auto& row : table.cells) sum += row[selector][metric].mean;
  return {.mean = sum / static_cast<double>(table.cells.size())};
}

Estimate lead_of(const Table& table, const std::string& over, std::size_t metric) {
  for (const Table::Lead& lead : table.leads)
    if (lead.over == over) return lead.rows.back()[metric];
  return {};
}

std::string settings_html(const std::vector<ComparedRun>& runs) {
  const auto lines = differing_settings(runs);
  if (lines.empty()) return how_to_read("All keys of the configurations are equal.");
  std::string head = element("th", {{"scope", "col"}}, "Key"), body;
  for (const ComparedRun& run : runs) head += element("th", {{"scope", "col"}, {"class", "word"}}, escaped(run.name));
  for (const auto& line : lines) {
    std::string row = element("th", {{"scope", "row"}}, escaped(line.front()));
    for (std::size_t i = 1; i < line.size(); ++i) row += element("td", {{"class", "word"}}, escaped(line[i]));
    body += element("tr", row);
  }
  return how_to_read("Keys of the configurations whose values differ; all others are equal.") +
         table_html("Settings that differ", element("thead", element("tr", head)) + element("tbody", body));
}

std::string leads_html(const std::vector<ComparedRun>& runs) {
  std::vector<std::string> figures;
  for (std::size_t metric = 0; metric < train::kMetrics.size(); ++metric) {
    DotPlot plot{.title = train::kMetrics[metric].title,
                 .alternative = "SV-net minus other selectors in held-out categories, with 95 % intervals",
                 .rows = {},
                 .differences = true};
    for (const char* over : {"rand", "top", "broadside", "phi_map"}) {
      std::vector<DotRow> rows;
      for (const ComparedRun& run : runs)
        if (const Table* table = table_of(run, true))
          if (const Estimate lead = lead_of(*table, over, metric); lead.is_known())
            rows.push_back({.label = run.name, .value = lead, .stands_out = true});
      if (rows.empty()) continue;
      plot.rows.push_back({.label = "over the " + selector_label(over)});
      plot.rows.insert(plot.rows.end(), rows.begin(), rows.end());
    }
    figures.push_back(dot_plot(plot));
  }
  const std::string html = plots(figures);
  if (html.empty()) return how_to_read("No run has a table of held-out categories with SV-net.");
  return how_to_read(
             "SV-net minus another selector in held-out categories, as the mean over the pipelines of each run: "
             "to the right of the line at 0, SV-net is better. A bar is the 95 % interval over categories; a "
             "hollow dot means that the difference is not sure.") +
         html;
}

/// The selectors of all runs, in the order of the first that has them.
std::vector<std::string> all_selectors(const std::vector<ComparedRun>& runs, bool held_out) {
  std::vector<std::string> names;
  for (const ComparedRun& run : runs)
    if (const Table* table = table_of(run, held_out))
      for (const std::string& name : table->selectors)
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

std::string levels_html(const std::vector<ComparedRun>& runs, bool held_out) {
  const std::vector<std::string> selectors = all_selectors(runs, held_out);
  if (selectors.empty()) return "";
  std::string head = element("th", {{"scope", "col"}}, "Run"), body;
  for (const train::Metric& metric : train::kMetrics) head += element("th", {{"scope", "col"}}, escaped(metric.title));
  for (const std::string& selector : selectors) {
    body += element("tr", {{"class", "group"}},
                    element("th", {{"scope", "rowgroup"}, {"colspan", std::to_string(train::kMetrics.size() + 1)}},
                            escaped(selector_label(selector))));
    for (const ComparedRun& run : runs) {
      const Table* table = table_of(run, held_out);
      if (table == nullptr) continue;
      const auto at = std::find(table->selectors.begin(), table->selectors.end(), selector);
      if (at == table->selectors.end()) continue;
      std::string row = element("th", {{"scope", "row"}}, escaped(run.name));
      for (std::size_t metric = 0; metric < train::kMetrics.size(); ++metric)
        row += element(
            "td",
            escaped(number(
                mean_over_pipelines(*table, static_cast<std::size_t>(at - table->selectors.begin()), metric).mean)));
      body += element("tr", row);
    }
  }
  const char* title = held_out ? "Held-out categories" : "Training categories";
  return element("h3", title) + "\n" +
         table_html(title, element("thead", element("tr", head)) + element("tbody", body));
}

std::string curves_html(const std::vector<ComparedRun>& runs) {
  const std::pair<const char*, std::vector<double> TrainingCurves::*> charts[] = {
      {"Loss", &TrainingCurves::loss},
      {"Loss, validation", &TrainingCurves::validation_loss},
      {"Spearman, validation", &TrainingCurves::validation_spearman},
      {"Regret, validation", &TrainingCurves::validation_regret}};
  std::vector<std::string> figures;
  for (const auto& [title, values] : charts) {
    LineChart chart{title, {}};
    for (const ComparedRun& run : runs)
      if (run.curves) chart.lines.push_back({run.name, (*run.curves).*values});
    figures.push_back(line_chart(chart));
  }
  const std::string html = plots(figures);
  return html.empty() ? how_to_read("No run has a metrics.csv: their heads were fitted without epochs.")
                      : how_to_read("One value per epoch; runs that were fitted in closed form have no curve.") + html;
}

std::string lead_summary(const std::vector<ComparedRun>& runs) {
  std::string items;
  for (const ComparedRun& run : runs)
    if (const Table* table = table_of(run, true))
      if (const Estimate lead = lead_of(*table, "rand", 0); lead.is_known())
        items += element("li", element("strong", escaped(run.name)) +
                                   escaped(": SV-net is " + estimate_text(lead, true) + " " + metric_words(0) +
                                           " ahead of random views; " + certainty_words(lead) + ".")) +
                 "\n";
  return items.empty() ? "" : element("ul", items) + "\n";
}

}  // namespace

ComparedRun read_compared_run(const fs::path& folder) {
  ComparedRun run{.name = fs::weakly_canonical(folder).filename().string(), .settings = {}, .tables = {}, .curves = {}};
  train::Config config = train::read_config(fs::canonical(folder) / "config.yaml");
  for (const train::BoundKey& key : train::bound_keys(config)) run.settings.push_back({key.name, key.write({})});
  run.tables = read_tables(folder);
  run.curves = read_curves(folder);
  return run;
}

void name_apart(std::vector<ComparedRun>& runs, const std::vector<fs::path>& folders) {
  std::map<std::string, int> uses;
  for (const ComparedRun& run : runs) ++uses[run.name];
  for (std::size_t r = 0; r < runs.size(); ++r)
    if (uses[runs[r].name] > 1) runs[r].name = folders[r].lexically_normal().string();
}

std::vector<std::vector<std::string>> differing_settings(const std::vector<ComparedRun>& runs) {
  std::vector<std::vector<std::string>> lines;
  for (std::size_t key = 0; key < runs.front().settings.size(); ++key) {
    std::vector<std::string> line{runs.front().settings[key].name};
    for (const ComparedRun& run : runs) line.push_back(run.settings[key].value);
    if (std::any_of(line.begin() + 1, line.end(), [&](const std::string& value) { return value != line[1]; }))
      lines.push_back(std::move(line));
  }
  return lines;
}

std::string comparison_html(const std::vector<ComparedRun>& runs) {
  std::vector<std::string> names;
  for (const ComparedRun& run : runs) names.push_back(run.name);
  Page page{.title = "Runs side by side",
            .lead = element("p", {{"class", "summary"}},
                            escaped(joined(runs.size(), " runs: ", joined_with(", ", names), "."))) +
                    "\n" + lead_summary(runs),
            .sections = {}};
  page.sections = {{"settings", "Settings that differ", settings_html(runs)},
                   {"leads", "SV-net's lead", leads_html(runs)},
                   {"levels", "Means",
                    how_to_read("Means over problems, and over the pipelines of each run; 1 is the best value. Compare "
                                "selectors within a run: runs with other data or pipelines have other problems.") +
                        levels_html(runs, true) + levels_html(runs, false)},
                   {"training", "Training", curves_html(runs)}};
  return page_html(page);
}

}  // namespace svnet::report
