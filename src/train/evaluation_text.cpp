#include "train/evaluation_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/text.h"

namespace svnet::train {
namespace {

std::string padded(std::string text, std::size_t width) {
  if (text.size() < width) text.append(width - text.size(), ' ');
  return text;
}

std::string number(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

std::string signed_number(double value) { return (value < 0 ? "" : "+") + number(value, 3); }

std::string interval_text(const Interval& interval) {
  if (std::isnan(interval.low)) return "";
  return " [" + signed_number(interval.low) + ", " + signed_number(interval.high) + "]";
}

nlohmann::ordered_json with_interval(double mean, const Interval& interval) {
  return {{"mean", mean}, {"low", interval.low}, {"high", interval.high}};  // NaN is written as null
}

/// What a row of differences is about: a pipeline, or their mean.
std::string row_name(const EvaluationTable& table, std::size_t row) {
  return row < table.pipelines.size() ? table.pipelines[row] : "mean";
}

/// The number of views of a selector that may be SV-net's: 1 of "svnet", 2 of "svnet_2"; 0 of others.
Index views_of_svnet(const std::string& selector) {
  if (selector == "svnet") return 1;
  for (Index views = 2; views <= kMostViews; ++views)
    if (selector == name_with_views("svnet", views)) return views;
  return 0;
}

/// Several views are compared with one view of SV-net, with as many random ones, and with the top view; one view with
/// all others. Those that the head of the next view chooses are compared with those of SV-net's rule.
bool is_compared(const std::string& selector, const std::string& baseline) {
  for (const auto& [next, rule] : {std::pair{"next", "svnet"}, {"top_next", "top_svnet"}})
    for (Index views = 2; views <= kMostViews; ++views)
      if (selector == name_with_views(next, views) && baseline == name_with_views(rule, views)) return true;
  const Index views = views_of_svnet(selector);
  const bool of_several = std::isdigit(static_cast<unsigned char>(baseline.back())) != 0;
  if (views <= 1) return views == 1 && !of_several && baseline != "svnet";
  return baseline == "svnet" || baseline == "top" || baseline == name_with_views("rand", views);
}

/// Calls use(selector, baseline, row, differences per metric) for each of SV-net's selectors and baselines.
template <class Use>
void for_each_difference(const EvaluationTable& table, const Use& use) {
  for (std::size_t s = 0; s < table.selectors.size(); ++s)
    for (const auto& [baseline, rows] : table.differences)
      if (is_compared(table.selectors[s], baseline))
        for (std::size_t row = 0; row < rows.size(); ++row) use(table.selectors[s], baseline, row, rows[row][s]);
}

/// SV-net minus each selector to compare with; empty if the table does not have SV-net.
std::string differences_text(const EvaluationTable& table) {
  std::string text;
  for_each_difference(table, [&](const std::string& selector, const std::string& baseline, std::size_t row,
                                 const PerMetric<Difference>& differences) {
    if (text.empty()) text = "SV-net minus another selector, with 95 % intervals over categories:\n";
    text += "  " + padded((selector == "svnet" ? "- " : selector + " - ") + baseline, 26) +
            padded(row_name(table, row), 22);
    for (std::size_t m = 0; m < kMetrics.size(); ++m)
      text += padded(std::string(kMetrics[m].title) + " " + signed_number(differences[m].mean) +
                         interval_text(differences[m].interval),
                     32);
    while (text.back() == ' ') text.pop_back();
    text += "\n";
  });
  return text;
}

}  // namespace

std::string table_text(const EvaluationTable& table, const std::string& title) {
  constexpr std::size_t kColumn = 22;
  std::size_t first = 10;
  for (const auto& name : table.pipelines) first = std::max(first, name.size() + 2);
  std::string metrics;
  for (const Metric& metric : kMetrics) metrics += (metrics.empty() ? "" : " / ") + std::string(metric.title);
  std::string text =
      title + " (" + metrics + ", mean of " + std::to_string(table.problems) + " problems)\n" + padded("", first);
  for (const auto& selector : table.selectors) text += padded(selector, kColumn);
  double largest_error = 0;
  for (std::size_t p = 0; p < table.pipelines.size(); ++p) {
    text += "\n" + padded(table.pipelines[p], first);
    for (const auto& cell : table.cells[p]) {
      std::string values;
      for (const Mean& mean : cell) {
        values += (values.empty() ? "" : " / ") + number(mean.mean, 3);
        largest_error = std::max(largest_error, mean.standard_error);
      }
      text += padded(values, kColumn);
    }
    while (text.back() == ' ') text.pop_back();
  }
  return text + "\nstandard error of a mean: at most " + number(largest_error, 4) + "\n" + differences_text(table);
}

std::string columns_text(const EvaluationTables& tables) {
  std::string text = "Columns: the views that are clustered.\n";
  const auto has = [&](const std::string& selector) {
    return std::ranges::any_of(tables, [&](const auto& table) {
      return std::ranges::find(table.second.selectors, selector) != table.second.selectors.end();
    });
  };
  bool several = false;
  for (const SelectorKind& kind : selector_kinds()) {
    if (has(kind.name) || (kind.fewest > 1 && has(name_with_views(kind.name, kind.fewest))))
      text += "  " + padded(kind.name, 12) + kind.help + "\n";
    several = several || has(name_with_views(kind.name, 2));
  }
  if (several) text += "  " + padded("…_2, …_3", 14) + "the two, three best or random views of each object, fused\n";
  text += "Numbers: how well the clusters agree with the categories, 1 is perfect.\n";
  for (const Metric& metric : kMetrics) text += "  " + padded(metric.title, 12) + metric.help + "\n";
  return text;
}

nlohmann::ordered_json differences_json(const EvaluationTable& table) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for_each_difference(table, [&](const std::string& selector, const std::string& baseline, std::size_t row,
                                 const PerMetric<Difference>& differences) {
    for (std::size_t m = 0; m < kMetrics.size(); ++m)
      json[row_name(table, row)][joined(selector, "-", baseline)][kMetrics[m].name] =
          with_interval(differences[m].mean, differences[m].interval);
  });
  return json;
}

std::string tables_json(const EvaluationTables& tables) {
  nlohmann::ordered_json json{{"format", 1}};
  for (const auto& [split, table] : tables) {
    json["problems"] = table.problems;
    for (std::size_t p = 0; p < table.pipelines.size(); ++p)
      for (std::size_t s = 0; s < table.selectors.size(); ++s)
        for (std::size_t m = 0; m < kMetrics.size(); ++m) {
          const Mean& mean = table.cells[p][s][m];
          json["tables"][split][table.pipelines[p]][table.selectors[s]][kMetrics[m].name] = {
              {"mean", mean.mean},
              {"standard_error", mean.standard_error},
              {"low", mean.interval.low},
              {"high", mean.interval.high}};
        }
    if (auto differences = differences_json(table); !differences.empty())
      json["differences"][split] = std::move(differences);
  }
  return json.dump(2) + "\n";
}

nlohmann::ordered_json intervals_json(const EvaluationTable& table) {
  nlohmann::ordered_json json;
  for (std::size_t p = 0; p < table.pipelines.size(); ++p)
    for (std::size_t s = 0; s < table.selectors.size(); ++s)
      for (std::size_t m = 0; m < kMetrics.size(); ++m) {
        const Mean& mean = table.cells[p][s][m];
        json[table.pipelines[p]][table.selectors[s]][kMetrics[m].name] = with_interval(mean.mean, mean.interval);
      }
  return json;
}

}  // namespace svnet::train
