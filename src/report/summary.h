#pragma once
#include <string>

#include "report/run_report.h"

namespace svnet::report {

/// The paragraphs below the title of a run's page, as markup: what was learnt and how sure it is, the settings, and
/// what another seed would change.
std::string summary_html(const RunReport& report);

/// SV-net's lead over another selector in the table of held-out categories, by the metric and the mean over pipelines;
/// its mean is NaN if the table lacks it.
Estimate overall_lead(const RunReport& report, const std::string& over, std::size_t metric);

/// "this is sure: the interval excludes 0", or why it is not.
std::string certainty_words(const Estimate& difference);

/// Facts side by side, as markup.
std::string facts_html(const std::vector<Setting>& facts);

/// Metrics in words: "Fowlkes–Mallows index (FM)".
std::string metric_words(std::size_t metric);

}  // namespace svnet::report
