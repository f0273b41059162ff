#include "report/summary.h"

#include "base/error.h"
#include "base/text.h"
#include "report/dot_plot.h"
#include "report/markup.h"
#include "report/names.h"

namespace svnet::report {
namespace {

std::string paragraph(const std::string& text) { return element("p", escaped(text)) + "\n"; }

std::string count_words(std::size_t count, const char* one, const char* many) {
  return joined(count, " ", count == 1 ? one : many);
}

std::string warning_html(const RunReport& report) {
  if (report.random_backbones.empty()) return "";
  return element(
             "p", {{"class", "warning"}},
             element("strong", escaped("Random weights: " + joined_with(", ", report.random_backbones) + ".")) +
                 escaped(" A backbone that was not trained knows little of what objects are. Take nothing below for a "
                         "result; name a folder of weights by weights.folder and run it again.")) +
         "\n";
}

std::string learnt_words(const RunReport& report) {
  const auto held_out = static_cast<std::size_t>(report.held_out_categories);
  const std::string choices =
      count_words(report.poses.size(), "pose", "poses") + " of " + count_words(held_out, "category", "categories");
  if (report.poses.empty())
    return "Fewer than two categories were held out, so this page cannot tell how well SV-net chooses views of objects "
           "that it never saw. svnet-crossval, or dataset.held_out, would tell it.";
  if (report.cross_validation)
    return joined("In each of ", report.folds.size(), " folds SV-net learnt without some categories which view of an ",
                  "object best shows what it is, and then chose a view of their objects from the top view alone: ",
                  choices, " in all, each by a model that had never seen the category.");
  return joined("SV-net learnt from ", report.training_categories,
                " categories which view of an object best shows what it is. Then it chose a view, from the top view "
                "alone, for each of ",
                choices, " that it had never seen.");
}

/// How far SV-net is ahead of a selector; empty if that is not known.
std::string lead_words(const RunReport& report, const std::string& over) {
  const Estimate lead = overall_lead(report, over, 0);
  if (!lead.is_known()) return "";
  const std::string than = over == "rand" ? "random views" : over == "top" ? "the top views" : selector_words(over);
  std::string text = joined(" Against ", than, ", the views that it chose ", lead.mean >= 0 ? "raise" : "lower",
                            " the ", metric_words(0), " of the clustering by ", number(std::abs(lead.mean)));
  if (lead.has_interval())
    text += " (95 % interval over categories: " + signed_number(lead.low) + " to " + signed_number(lead.high) + ")";
  return text + "; " + certainty_words(lead) + ".";
}

std::string fixed_rule_words(const RunReport& report) {
  std::string text;
  for (const char* rule : {"broadside", "phi_map"})
    if (const Estimate lead = overall_lead(report, rule, 0); lead.is_known())
      text += joined(text.empty() ? "" : "; ", "over ", selector_words(rule), " ", estimate_text(lead, true),
                     lead.is_sure()        ? ", sure"
                     : lead.has_interval() ? ", not sure"
                                           : "");
  if (!text.empty()) return "SV-net's lead over rules that need no learning: " + text + ".";
  if (report.poses.empty()) return "";
  return "The fixed rules broadside and phi_map were not compared; svnet-eval --selectors "
         "top,rand,broadside,phi_map,svnet does it.";
}

std::string within_pose_words(const RunReport& report) {
  double known = 0, over_top = 0, over_mean = 0;
  for (const ShownPose& pose : report.poses) {
    const double chosen = pose.views[pose.chosen].score;
    if (!std::isfinite(chosen)) continue;
    ++known;
    over_top += chosen > pose.views[pose.top].score ? 1 : 0;
    over_mean += chosen > pose.mean_score ? 1 : 0;
  }
  if (known == 0) return "";
  return joined("Pose by pose, the chosen view scores higher than the top view in ", number(100 * over_top / known, 0),
                " % of ", known, " poses, and higher than a random view on average in ",
                number(100 * over_mean / known, 0), " %.");
}

std::string seed_words(const RunReport& report) {
  double error = 0;
  std::uint64_t problems = 0;
  for (const Table& table : report.tables) {
    error = std::max(error, table.largest_standard_error);
    problems = std::max(problems, table.problems);
  }
  std::string text = "What another seed would change: it would draw other clustering problems";
  if (report.cross_validation) text += ", other folds";
  if (!report.closed_form) text += ", and other random numbers to begin training with";
  text += ".";
  if (error > 0)
    text += joined(" Other problems alone move a mean over ", problems, " problems by about ", number(error),
                   " (its standard error).");
  if (report.closed_form)
    text +=
        " The head is fitted in closed form, from no random start; the seed draws only its scores and the categories "
        "by "
        "which its penalty is chosen.";
  text +=
      " How much SV-net's choices vary with the seed, one run cannot say: repeat it with --set seed=N and compare the "
      "run "
      "folders by svnet-report.";
  return text + " The intervals are about something else: how much other categories of the same kind would change.";
}

}  // namespace

Estimate overall_lead(const RunReport& report, const std::string& over, std::size_t metric) {
  for (const Table& table : report.tables)
    for (const Table::Lead& lead : table.leads)
      if (table.held_out && lead.over == over && !lead.rows.empty()) return lead.rows.back()[metric];
  return {};
}

std::string certainty_words(const Estimate& difference) {
  if (!difference.has_interval())
    return "how sure this is cannot be told, as there are too few categories for an interval";
  if (difference.is_sure()) return "this is sure, as the interval excludes 0";
  return "this is not sure, as the interval includes 0";
}

std::string facts_html(const std::vector<Setting>& facts) {
  std::string inner;
  for (const Setting& fact : facts)
    inner += element("dt", escaped(fact.name)) + element("dd", escaped(fact.value)) + "\n";
  return inner.empty() ? "" : element("dl", {{"class", "facts"}}, inner) + "\n";
}

std::string metric_words(std::size_t metric) {
  const std::string name = train::kMetrics[metric].name;
  if (name == "fm") return "Fowlkes–Mallows index (FM)";
  if (name == "nmi") return "normalised mutual information (NMI)";
  return train::kMetrics[metric].title;
}

std::string summary_html(const RunReport& report) {
  std::string html = warning_html(report);
  html += element("p", {{"class", "summary"}},
                  escaped(learnt_words(report) + lead_words(report, "rand") + lead_words(report, "top"))) +
          "\n";
  for (const std::string& text : {fixed_rule_words(report), within_pose_words(report)})
    if (!text.empty()) html += paragraph(text);
  return html + facts_html(report.settings) + paragraph(seed_words(report));
}

}  // namespace svnet::report
