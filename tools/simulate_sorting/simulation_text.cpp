#include "simulate_sorting/simulation_text.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace svnet {
using Json = nlohmann::ordered_json;
using sorting::GroupRule;

namespace {

template <class... Values>
std::string formatted(const char* format, Values... values) {
  char text[200];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

Json rule_of_groups(const GroupRule& groups) {
  switch (groups.kind) {
    case GroupRule::Kind::categories:
      return "categories of the table";
    case GroupRule::Kind::estimated:
      return "auto";
    case GroupRule::Kind::fixed:
      return groups.count;
  }
  fail("[simulation] no rule of groups has this number");
}

Json categories_of(const SimulationReport& report, const sorting::Table& table) {
  Json names = Json::array();
  for (const std::int32_t category : table.categories)
    names.push_back(report.dataset.categories[static_cast<std::size_t>(category)]);
  return names;
}

}  // namespace

std::string simulation_text(const SimulationReport& report) {
  std::string text =
      joined(report.options.tables, report.options.tables == 1 ? " table" : " tables", " of ", report.options.objects,
             " objects, from ", report.dataset.categories.size(), " categories; means of a table\n");
  text += formatted("%-10s %13s %8s %9s   %s\n", "views", "in wrong bins", "moves", "seconds",
                    "fewer wrong than top (95 %)");
  for (std::size_t s = 0; s < report.selectors.size(); ++s) {
    const sorting::SelectorSummary& row = report.summaries[s];
    text += formatted("%-10s %7.2f %4.0f %% %8.1f %9.1f", report.selectors[s].name.c_str(), row.wrong,
                      100 * row.wrong / static_cast<double>(report.options.objects), row.moves, row.seconds);
    if (s > 0) {
      text += formatted("   %+.2f", row.fewer_than_first);
      if (report.options.tables > 1) text += formatted(" (%+.2f to %+.2f)", row.interval.low, row.interval.high);
    }
    text += "\n";
  }
  return text;
}

std::string simulation_json(const SimulationReport& report) {
  const sorting::SimulationOptions& options = report.options;
  Json rows = Json::array(), tables = Json::array();
  for (std::size_t s = 0; s < report.selectors.size(); ++s) {
    const sorting::SelectorSummary& row = report.summaries[s];
    Json fewer{{"mean", row.fewer_than_first}, {"low", row.interval.low}, {"high", row.interval.high}};  // NaN: null
    rows.push_back(Json{{"name", report.selectors[s].name},
                        {"views", report.selectors[s].views},
                        {"wrong_objects", row.wrong},
                        {"wrong_share", row.wrong / static_cast<double>(options.objects)},
                        {"moves", row.moves},
                        {"seconds", row.seconds},
                        {"fewer_wrong_than_top", std::move(fewer)}});
  }
  for (const sorting::SortedTable& table : report.tables) {
    Json wrong;
    for (std::size_t s = 0; s < report.selectors.size(); ++s)
      wrong[report.selectors[s].name] = table.outcomes[s].wrong_count;
    tables.push_back(Json{{"categories", categories_of(report, table.table)}, {"wrong_objects", std::move(wrong)}});
  }
  Json document{{"dataset", report.dataset_name},
                {"categories", report.dataset.categories},
                {"model", report.model.empty() ? Json() : Json(report.model)},
                {"backbone", report.backbone},
                {"weights_sha256", report.weights_sha256},
                {"seed", options.seed},
                {"objects", options.objects},
                {"groups", rule_of_groups(options.groups)},
                {"move_time",
                 {{"rule", "start_s + angle / speed_deg_per_s, of each move"},
                  {"start_s", options.time.start_s},
                  {"speed_deg_per_s", options.time.speed_deg_per_s}}},
                {"selectors", std::move(rows)},
                {"tables", std::move(tables)}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace svnet
