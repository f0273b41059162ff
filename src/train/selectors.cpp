#include "train/selectors.h"

#include <algorithm>

#include "base/error.h"
#include "base/text.h"

namespace svnet::train {
namespace {

const SelectorKind kSelectors[] = {
    {"top", "the top view", true, true, [](const SelectorInputs& in) { return top_views(in.dataset); }},
    {"rand", "a random view, drawn for each problem", true, true,
     [](const SelectorInputs&) { return std::vector<std::int32_t>(); }},
    {"opt_glob", "the view with the best global score", true, false,
     [](const SelectorInputs& in) { return best_views(in.dataset, in.scores().global); }},
    {"opt_ind", "the view with the best individual score", true, false,
     [](const SelectorInputs& in) { return best_views(in.dataset, in.scores().individual); }},
    {"svnet", "the view with the best score that SV-net predicts", false, true,
     [](const SelectorInputs& in) { return best_views(in.dataset, in.predicted); }},
};

bool is_default(const SelectorKind& kind, Split split) {
  switch (split) {
    case Split::training:
      return kind.of_training;
    case Split::held_out:
      return kind.of_held_out;
  }
  return false;
}

}  // namespace

std::span<const SelectorKind> selector_kinds() { return kSelectors; }

std::vector<const SelectorKind*> selectors_of_table(const std::vector<std::string>& names, Split split) {
  std::vector<const SelectorKind*> kinds;
  if (names.empty()) {
    for (const SelectorKind& kind : kSelectors)
      if (is_default(kind, split)) kinds.push_back(&kind);
    return kinds;
  }
  std::vector<std::string> known;
  for (const SelectorKind& kind : kSelectors) known.emplace_back(kind.name);
  for (const std::string& name : names) {
    const auto at = std::find(known.begin(), known.end(), name);
    check(at != known.end(), "evaluation.selectors: there is no selector '", name, "'", suggestion(name, known));
    kinds.push_back(&kSelectors[at - known.begin()]);
  }
  return kinds;
}

std::vector<std::int32_t> top_views(const ViewDataset& dataset) {
  std::vector<std::int32_t> views;
  for (const auto& pose : dataset.poses) views.push_back(static_cast<std::int32_t>(pose.top_view));
  return views;
}

std::vector<std::int32_t> best_views(const ViewDataset& dataset, std::span<const double> scores) {
  check(scores.size() == dataset.views.size(), "[evaluation] ", scores.size(), " scores for ", dataset.views.size(),
        " views");
  std::vector<std::int32_t> views = top_views(dataset);
  for (std::size_t p = 0; p < dataset.poses.size(); ++p) {
    const auto& pose = dataset.poses[p];
    double best = -1;
    for (Index view = pose.first_view; view < pose.first_view + pose.view_count; ++view)
      if (scores[static_cast<std::size_t>(view)] > best) {  // false for NaN
        best = scores[static_cast<std::size_t>(view)];
        views[p] = static_cast<std::int32_t>(view);
      }
  }
  return views;
}

}  // namespace svnet::train
