#include "report/stored_results.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/split.h"
#include "base/text.h"
#include "io/files/atomic_file.h"
#include "io/files/whole_file.h"

namespace svnet::report {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kRunAgain = "; run svnet-eval, or svnet-crossval, on this run again";

ordered_json read_json(const fs::path& file) {
  check(fs::exists(file), file.string(), ": no such file", kRunAgain);
  const std::string text = io::whole_file(file);
  ordered_json json = ordered_json::parse(text, nullptr, false);
  check(json.is_object(), file.string(), ": is damaged, it holds no JSON object", kRunAgain);
  const auto format = json.find("format");
  check(format != json.end() && *format == 1, file.string(),
        ": its format is not 1; it is damaged, or another version of ", "svnet made it", kRunAgain);
  return json;
}

/// Calls `read`, and throws Error that names the file if the JSON is not as it expects.
template <class Result>
Result from_json(const fs::path& file, const std::function<Result(const ordered_json&)>& read) {
  const ordered_json json = read_json(file);
  try {
    return read(json);
  } catch (const ordered_json::exception& error) {
    fail(file.string(), ": is damaged: ", printable(error.what()), kRunAgain);
  }
}

double number_or_nan(const ordered_json& value) { return value.is_null() ? std::nan("") : value.get<double>(); }

/// null for NaN, as the library writes it.
ordered_json json_number(double value) { return value; }

double member_or_nan(const ordered_json& object, const char* name) {
  const auto member = object.find(name);
  return member == object.end() ? std::nan("") : number_or_nan(*member);
}

Estimate estimate_of(const ordered_json& json) {
  return {number_or_nan(json.at("mean")), member_or_nan(json, "low"), member_or_nan(json, "high")};
}

train::PerMetric<Estimate> estimates_of(const ordered_json& json) {
  train::PerMetric<Estimate> estimates;
  for (std::size_t m = 0; m < train::kMetrics.size(); ++m) estimates[m] = estimate_of(json.at(train::kMetrics[m].name));
  return estimates;
}

Table table_of_json(const ordered_json& json) {
  Table table;
  for (const auto& [pipeline, selectors] : json.items()) {
    table.pipelines.push_back(pipeline);
    if (table.selectors.empty())
      for (const auto& [selector, metrics] : selectors.items()) table.selectors.push_back(selector);
    table.cells.emplace_back();
    for (const std::string& selector : table.selectors) {
      table.cells.back().push_back(estimates_of(selectors.at(selector)));
      for (const train::Metric& metric : train::kMetrics)
        if (const double error = member_or_nan(selectors.at(selector).at(metric.name), "standard_error"); error > 0)
          table.largest_standard_error = std::max(table.largest_standard_error, error);
    }
  }
  return table;
}

/// SV-net's leads, in an order that begins with what matters most.
std::vector<Table::Lead> leads_of_json(const ordered_json& json, const Table& table) {
  std::vector<std::string> rows = table.pipelines;
  if (rows.size() > 1) rows.emplace_back("mean");
  std::vector<Table::Lead> leads;
  for (const char* over : {"rand", "top", "broadside", "phi_map"}) {
    const std::string key = std::string("svnet-") + over;
    if (!json.at(rows.front()).contains(key)) continue;
    leads.push_back({over, {}});
    for (const std::string& row : rows) leads.back().rows.push_back(estimates_of(json.at(row).at(key)));
  }
  return leads;
}

std::vector<std::string> lines_of(const fs::path& file) {
  const std::string text = io::whole_file(file);
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    if (!lines.back().empty() && lines.back().back() == '\r') lines.back().pop_back();
    begin = end + 1;
  }
  return lines;
}

double cell_number(const fs::path& file, std::size_t line, const std::string& cell) {
  double value = std::nan("");
  check(cell.empty() || parse_number(cell, value), file.string(), ", line ", line, ": '", printable(cell),
        "' is not a number; remove the file to do without it");
  return value;
}

}  // namespace

void write_predictions(const fs::path& folder, const ViewDataset& dataset,
                       const std::vector<ViewPrediction>& predictions) {
  ordered_json json{{"format", 1}, {"views", ordered_json::array()}};
  for (std::size_t v = 0; v < dataset.views.size(); ++v) {
    const ViewPrediction& p = predictions[v];
    json["views"].push_back({dataset.views[v].path, p.held_out, json_number(p.predicted), json_number(p.score),
                             json_number(p.standard_error)});
  }
  io::write_atomically(folder / "predictions.json", json.dump() + "\n");
}

std::vector<ViewPrediction> read_predictions(const fs::path& folder, const ViewDataset& dataset) {
  const fs::path file = folder / "predictions.json";
  return from_json<std::vector<ViewPrediction>>(file, [&](const ordered_json& json) {
    const auto& views = json.at("views");
    check(views.size() == dataset.views.size(), file.string(), ": is about ", views.size(), " views, the dataset ",
          dataset.root.string(), " has ", dataset.views.size(), kRunAgain);
    std::vector<ViewPrediction> predictions;
    for (std::size_t v = 0; v < views.size(); ++v) {
      const auto& view = views.at(v);
      check(view.at(0) == dataset.views[v].path, file.string(), ": view ", v, " is ",
            printable(view.at(0).get<std::string>()), ", that of the dataset is ", dataset.views[v].path, kRunAgain);
      predictions.push_back({.predicted = number_or_nan(view.at(2)),
                             .score = number_or_nan(view.at(3)),
                             .standard_error = number_or_nan(view.at(4)),
                             .held_out = view.at(1).get<bool>()});
    }
    return predictions;
  });
}

std::vector<Table> read_tables(const fs::path& folder) {
  return from_json<std::vector<Table>>(folder / "evaluation.json", [](const ordered_json& json) {
    std::vector<Table> tables;
    for (const char* split : {"held_out", "training"}) {
      if (!json.at("tables").contains(split)) continue;
      tables.push_back(table_of_json(json.at("tables").at(split)));
      tables.back().held_out = std::string_view(split) == "held_out";
      tables.back().problems = json.at("problems").get<std::uint64_t>();
      if (json.contains("differences") && json.at("differences").contains(split))
        tables.back().leads = leads_of_json(json.at("differences").at(split), tables.back());
    }
    return tables;
  });
}

std::vector<FoldFigures> read_folds(const fs::path& folder) {
  return from_json<std::vector<FoldFigures>>(folder / "crossval.json", [](const ordered_json& json) {
    std::vector<FoldFigures> folds;
    for (const auto& fold : json.at("folds")) {
      const auto& w = fold.at("within_pose");
      folds.push_back({.held_out = fold.at("held_out").get<std::vector<std::string>>(),
                       .within_pose = {.poses = w.at("poses").get<Index>(),
                                       .spearman = number_or_nan(w.at("spearman")),
                                       .regret = number_or_nan(w.at("regret")),
                                       .better_than_top = number_or_nan(w.at("better_than_top")),
                                       .better_than_rand = number_or_nan(w.at("better_than_rand"))}});
    }
    return folds;
  });
}

std::optional<TrainingCurves> read_curves(const fs::path& folder) {
  const fs::path file = folder / "metrics.csv";
  if (!fs::exists(file)) return {};
  const std::vector<std::string> lines = lines_of(file);
  const std::pair<const char*, std::vector<double> TrainingCurves::*> columns[] = {
      {"loss", &TrainingCurves::loss},
      {"validation_loss", &TrainingCurves::validation_loss},
      {"validation_spearman", &TrainingCurves::validation_spearman},
      {"validation_regret", &TrainingCurves::validation_regret}};
  TrainingCurves curves;
  if (lines.empty()) return curves;
  const std::vector<std::string> header = split(lines.front(), ',');
  for (std::size_t line = 1; line < lines.size(); ++line) {
    const std::vector<std::string> cells = split(lines[line], ',');
    for (const auto& [name, values] : columns) {
      const auto column = static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin());
      (curves.*values).push_back(column < cells.size() ? cell_number(file, line + 1, cells[column]) : std::nan(""));
    }
  }
  return curves;
}

}  // namespace svnet::report
