#include "train/paper_figures.h"

#include <algorithm>
#include <set>
#include <string_view>

namespace svnet::train {
namespace {

struct Figure {
  Split split;
  std::string_view pipeline, selector, values;  ///< values: FM / NMI / purity
};

constexpr Figure kFigures[] = {
    {Split::training, "xception_ward", "top", ".48 / .78 / .73"},
    {Split::training, "xception_ward", "rand", ".50 / .78 / .74"},
    {Split::training, "xception_ward", "opt_glob", ".85 / .94 / .93"},
    {Split::training, "xception_ward", "opt_ind", ".87 / .95 / .94"},
    {Split::training, "xception_kmeans", "top", ".44 / .75 / .71"},
    {Split::training, "xception_kmeans", "rand", ".46 / .76 / .72"},
    {Split::training, "xception_kmeans", "opt_glob", ".81 / .93 / .91"},
    {Split::training, "xception_kmeans", "opt_ind", ".83 / .93 / .92"},
    {Split::training, "vgg19_ward", "top", ".39 / .72 / .67"},
    {Split::training, "vgg19_ward", "rand", ".38 / .72 / .66"},
    {Split::training, "vgg19_ward", "opt_glob", ".49 / .78 / .73"},
    {Split::training, "vgg19_ward", "opt_ind", ".52 / .79 / .74"},
    {Split::held_out, "xception_ward", "top", ".44 / .51 / .70"},
    {Split::held_out, "xception_ward", "rand", ".48 / .56 / .74"},
    {Split::held_out, "xception_ward", "svnet", ".55 / .63 / .78"},
    {Split::held_out, "xception_kmeans", "top", ".44 / .51 / .70"},
    {Split::held_out, "xception_kmeans", "rand", ".48 / .55 / .73"},
    {Split::held_out, "xception_kmeans", "svnet", ".55 / .62 / .78"},
    {Split::held_out, "vgg19_ward", "top", ".46 / .53 / .71"},
    {Split::held_out, "vgg19_ward", "rand", ".44 / .51 / .70"},
    {Split::held_out, "vgg19_ward", "svnet", ".48 / .55 / .73"},
};

}  // namespace

bool holds_out_papers_categories(const Config& config) {
  return std::set<std::string>(config.dataset.held_out.begin(), config.dataset.held_out.end()) ==
         std::set<std::string>{"comb", "hammer", "knife", "toothbrush", "wrench"};
}

std::string paper_figures_text(const EvaluationTable& table, Split split) {
  std::string text;
  for (const std::string& pipeline : table.pipelines) {
    std::string row;
    for (const Figure& figure : kFigures)
      if (figure.split == split && figure.pipeline == pipeline &&
          std::ranges::find(table.selectors, figure.selector) != table.selectors.end())
        row += joined("  ", figure.selector, " ", figure.values);
    if (!row.empty()) text += "  " + pipeline + ":" + row + "\n";
  }
  return text.empty() ? text : "The paper, on its own images (FM / NMI / purity):\n" + text;
}

}  // namespace svnet::train
