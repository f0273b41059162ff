#pragma once
#include <string>

#include "train/config/config.h"
#include "train/evaluation.h"

namespace svnet::train {

/// Whether the configuration holds out the paper's five categories: comb, hammer, knife, toothbrush, wrench.
bool holds_out_papers_categories(const Config& config);

/// The figures that the paper reports on its own images for the table's pipelines and selectors, as text below the
/// table. Empty if it reports none of them. Source: Guérin et al., IROS 2018, tables 1 and 2.
std::string paper_figures_text(const EvaluationTable& table, Split split);

}  // namespace svnet::train
