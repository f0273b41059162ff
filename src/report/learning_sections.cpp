#include "report/learning_sections.h"

#include <cmath>

#include "base/error.h"
#include "report/line_chart.h"
#include "report/markup.h"
#include "report/page.h"

namespace svnet::report {
namespace {

std::string plots_html(const std::vector<std::string>& plots) {
  std::string inner;
  for (const std::string& plot : plots)
    if (!plot.empty()) inner += element("figure", plot) + "\n";
  return inner.empty() ? "" : element("div", {{"class", "plots"}}, "\n" + inner) + "\n";
}

std::string seconds_words(double seconds) {
  if (seconds < 60) return number(seconds, 1) + " s";
  return joined(static_cast<Index>(seconds) / 60, " min ", static_cast<Index>(seconds) % 60, " s");
}

std::string score_plot(const RunReport& report, bool held_out) {
  std::vector<BoxRow> rows;
  for (const CategoryScores& category : report.scores)
    if (category.held_out == held_out) rows.push_back(category.row);
  if (rows.empty()) return "";
  return box_plot(held_out ? "Held-out categories" : "Training categories", rows);
}

}  // namespace

std::string training_html(const RunReport& report) {
  if (!report.curves) {
    if (report.closed_form)
      return how_to_read(
          "SV-net's head was fitted in closed form, by ridge regression: there are no epochs, and so no curves.");
    return how_to_read(report.cross_validation
                           ? "Each fold trained its own SV-net; their curves are in the folders of the folds."
                           : "The run folder has no metrics.csv, so there are no curves.");
  }
  const TrainingCurves& curves = *report.curves;
  return how_to_read(
             "One value per epoch. The loss should fall; if it falls on the training views only, SV-net learns them by "
             "heart. Spearman says how well predictions order the views of a pose of the validation categories, regret "
             "how far the chosen view is below the best. The model is that of the best epoch.") +
         plots_html({line_chart({"Loss", {{"training", curves.loss}, {"validation", curves.validation_loss}}}),
                     line_chart({"Spearman, validation", {{"", curves.validation_spearman}}}),
                     line_chart({"Regret, validation", {{"", curves.validation_regret}}})});
}

std::string scores_html(const RunReport& report) {
  const std::string plots = plots_html({score_plot(report, true), score_plot(report, false)});
  if (plots.empty()) return "";
  return how_to_read(joined(
             "The ", report.target,
             " scores of all views of a category: the line spans 5 to 95 % of them, the box the "
             "middle half, the tick is the median. A blue dot is the mean of the views that SV-net chose, a ring that "
             "of the top views. A dot right of the box means that SV-net chooses from the best quarter.")) +
         plots;
}

std::string map_html(const RunReport& report) {
  if (!report.map) return "";
  const FeatureMap& map = *report.map;
  ScatterLimits limits{1e300, -1e300, 1e300, -1e300};
  for (const auto* points : {&map.top, &map.chosen})
    for (const ScatterPoint& point : *points)
      limits = {std::min(limits.low_x, point.x), std::max(limits.high_x, point.x), std::min(limits.low_y, point.y),
                std::max(limits.high_y, point.y)};
  const auto panel = [&](const char* title, const std::vector<ScatterPoint>& points, double silhouette) {
    return scatter(
        {.title = title,
         .alternative = joined(title, ": a map of the features of ", points.size(), " views of ", map.categories.size(),
                               " categories. Their mean silhouette is ", number(silhouette, 3), "."),
         .points = points,
         .limits = limits});
  };
  const double gain = map.chosen_silhouette - map.top_silhouette;
  return how_to_read(
             joined("Each marker is a view of a held-out pose: its features of ", map.backbone, " (", map.dimension,
                    " values) in their first two principal components, the same in both maps. Clustering works where "
                    "categories lie apart.")) +
         element("p",
                 escaped(joined(
                     "In all ", map.dimension, " dimensions, the mean silhouette (1: each view lies among its own ",
                     "category only; 0: between two; negative: nearer to another) is ", number(map.top_silhouette, 3),
                     " for the top views and ", number(map.chosen_silhouette, 3), " for the views that SV-net chose: ",
                     gain > 0 ? "categories lie further apart, so that clustering has it easier."
                              : "categories do not lie further apart."))) +
         "\n" + scatter_legend(map.categories) +
         plots_html({panel("Top views", map.top, map.top_silhouette),
                     panel("Views that SV-net chose", map.chosen, map.chosen_silhouette)});
}

std::string times_html(const RunReport& report) {
  if (report.times.empty()) return "";
  std::string body;
  double sum = 0;
  for (const train::StageTime& time : report.times) {
    sum += time.seconds;
    body += element("tr", element("th", {{"scope", "row"}}, escaped(time.stage)) +
                              element("td", escaped(seconds_words(time.seconds))) +
                              element("td", {{"class", "word"}}, time.reused ? "reused" : "made"));
  }
  body += element(
      "tr", element("th", {{"scope", "row"}}, "all") + element("td", escaped(seconds_words(sum))) + element("td", ""));
  const std::string head = element("th", {{"scope", "col"}}, "Stage") + element("th", {{"scope", "col"}}, "Time") +
                           element("th", {{"scope", "col"}, {"class", "word"}}, "Result");
  return how_to_read("How long each stage took when it last ran. A stage whose inputs have not changed is reused.") +
         table_html("Time per stage", element("thead", element("tr", head)) + element("tbody", body));
}

}  // namespace svnet::report
