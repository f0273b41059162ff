#include "train/evaluation_text.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

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
  return text + "\nstandard error of a mean: at most " + number(largest_error, 4) + "\n";
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
              {"mean", mean.mean}, {"standard_error", mean.standard_error}};
        }
  }
  return json.dump(2) + "\n";
}

}  // namespace svnet::train
