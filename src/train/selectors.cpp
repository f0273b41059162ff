#include "train/selectors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include "base/error.h"
#include "base/text.h"
#include "view/view_set.h"

namespace svnet::train {
namespace {

const SelectorKind kSelectors[] = {
    {"top", "the top view", true, true, 1, 1, [](const SelectorInputs& in, Index) { return top_views(in.dataset); }},
    {"rand", "a random view, drawn for each problem", true, true, 1, kMostViews,
     [](const SelectorInputs&, Index) { return std::vector<std::int32_t>(); }},
    {"broadside", "the view at phi 45 across the object's axis, a fixed rule", false, false, 1, 1,
     [](const SelectorInputs& in, Index) { return broadside_views(in.dataset, in.frames()); }},
    {"phi_map", "a view at the elevation with the best mean training score, a fixed rule", false, false, 1, 1,
     [](const SelectorInputs& in, Index) { return phi_map_views(in.dataset, in.training_scores.individual); }},
    {"opt_glob", "the view with the best global score", true, false, 1, kMostViews,
     [](const SelectorInputs& in, Index views) { return best_views(in.dataset, in.scores().global, views); }},
    {"opt_ind", "the view with the best individual score", true, false, 1, kMostViews,
     [](const SelectorInputs& in, Index views) { return best_views(in.dataset, in.scores().individual, views); }},
    {"svnet", "the view with the best score that SV-net predicts", false, true, 1, kMostViews,
     [](const SelectorInputs& in, Index views) { return view_sets(in.dataset, in.predicted, views); }},
    {"next", "SV-net's view, then those that sv_net.next_view ranks best given the pictures taken", false, false, 2,
     kMostViews,
     [](const SelectorInputs& in, Index views) {
       return views_after(in.dataset, best_views(in.dataset, in.predicted), in.next, views);
     }},
    {"top_svnet", "the top view and SV-net's", false, false, 2, kMostViews,
     [](const SelectorInputs& in, Index views) {
       return views_beside(in.dataset, top_views(in.dataset), in.predicted, views);
     }},
    {"top_next", "the top view, then those that sv_net.next_view ranks best given the pictures taken", false, false, 2,
     kMostViews,
     [](const SelectorInputs& in, Index views) {
       return views_after(in.dataset, top_views(in.dataset), in.next, views);
     }},
    {"move_25", "SV-net's view where it expects most of it, in 25 % of the poses; else the top view", false, false, 1,
     1, [](const SelectorInputs& in, Index) { return moved_views(in.dataset, in.predicted, 0.25); }},
    {"move_50", "the same in 50 % of the poses", false, false, 1, 1,
     [](const SelectorInputs& in, Index) { return moved_views(in.dataset, in.predicted, 0.5); }},
    {"move_75", "the same in 75 % of the poses", false, false, 1, 1,
     [](const SelectorInputs& in, Index) { return moved_views(in.dataset, in.predicted, 0.75); }},
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

std::string name_with_views(const std::string& selector, Index views) {
  return views == 1 ? selector : joined(selector, "_", views);
}

std::vector<Selector> chosen_by(std::span<const SelectorKind* const> kinds, const SelectorInputs& inputs,
                                Index most_views) {
  std::vector<Selector> selectors;
  for (Index views = 1; views <= most_views; ++views)
    for (const SelectorKind* kind : kinds)
      if (kind->fewest <= views && views <= kind->most)
        selectors.push_back({name_with_views(kind->name, views), kind->view(inputs, views), views});
  return selectors;
}

std::vector<std::int32_t> top_views(const ViewDataset& dataset) {
  std::vector<std::int32_t> views;
  for (const auto& pose : dataset.poses) views.push_back(static_cast<std::int32_t>(pose.top_view));
  return views;
}

std::vector<std::int32_t> broadside_views(const ViewDataset& dataset, std::span<const frame::TopFrame> frames) {
  constexpr double kRadians = std::numbers::pi / 180, kElevation_deg = 45;
  std::vector<std::int32_t> chosen;
  for (std::size_t p = 0; p < dataset.poses.size(); ++p) {
    const ViewDataset::Pose& pose = dataset.poses[p];
    const bool found = frames[p].axis.kind == frame::AxisKind::found;
    double least = std::numeric_limits<double>::infinity();
    Index best = pose.first_view;
    for (Index v = pose.first_view; v < pose.first_view + pose.view_count; ++v) {
      const View& view = dataset.views[static_cast<std::size_t>(v)];
      const double along = std::cos((view.theta_deg - frames[p].axis.direction_deg) * kRadians);
      // Degrees off the elevation, and off the plane across the axis.
      const double off = std::abs(view.phi_deg - kElevation_deg) +
                         (found && view.phi_deg < 90 ? std::asin(std::abs(along)) / kRadians : 0);
      if (off < least) {
        least = off;
        best = v;
      }
    }
    chosen.push_back(static_cast<std::int32_t>(best));
  }
  return chosen;
}

std::vector<std::int32_t> phi_map_views(const ViewDataset& dataset, std::span<const double> scores) {
  struct Sum {
    double sum = 0, count = 0;
  };
  std::map<int, Sum> by_phi;
  for (const auto& pose : dataset.poses) {
    Sum all;
    const auto each = [&](const auto& use) {
      for (Index v = pose.first_view; v < pose.first_view + pose.view_count; ++v)
        if (const double score = scores[static_cast<std::size_t>(v)]; std::isfinite(score)) use(v, score);
    };
    each([&](Index, double score) {
      all.sum += score;
      ++all.count;
    });
    each([&](Index v, double score) {
      Sum& sum = by_phi[dataset.views[static_cast<std::size_t>(v)].phi_deg];
      sum.sum += score - all.sum / all.count;
      ++sum.count;
    });
  }
  std::vector<double> mean(dataset.views.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t v = 0; v < mean.size(); ++v)
    if (const auto at = by_phi.find(dataset.views[v].phi_deg); at != by_phi.end())
      mean[v] = at->second.sum / at->second.count;
  return best_views(dataset, mean);
}

std::vector<std::int32_t> best_views(const ViewDataset& dataset, std::span<const double> scores, Index count) {
  check(scores.size() == dataset.views.size(), "[evaluation] ", scores.size(), " scores for ", dataset.views.size(),
        " views");
  std::vector<std::int32_t> views, of_pose;
  for (const auto& pose : dataset.poses) {
    of_pose.clear();
    for (Index view = pose.first_view; view < pose.first_view + pose.view_count; ++view)
      if (!std::isnan(scores[static_cast<std::size_t>(view)])) of_pose.push_back(static_cast<std::int32_t>(view));
    std::ranges::stable_sort(of_pose, std::ranges::greater(),
                             [&](std::int32_t view) { return scores[static_cast<std::size_t>(view)]; });
    if (of_pose.empty()) of_pose.push_back(static_cast<std::int32_t>(pose.top_view));
    for (Index i = 0; i < count; ++i) views.push_back(of_pose[static_cast<std::size_t>(i) % of_pose.size()]);
  }
  return views;
}

std::vector<std::int32_t> moved_views(const ViewDataset& dataset, std::span<const double> scores, double share) {
  const std::vector<std::int32_t> best = best_views(dataset, scores);
  std::vector<std::int32_t> chosen = top_views(dataset);
  std::vector<std::size_t> order(dataset.poses.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto margin = [&](std::size_t pose) {
    const double of_top = scores[static_cast<std::size_t>(chosen[pose])];
    return std::isnan(of_top) ? 0.0 : scores[static_cast<std::size_t>(best[pose])] - of_top;
  };
  std::vector<double> margins;
  for (std::size_t pose = 0; pose < order.size(); ++pose) margins.push_back(margin(pose));
  std::ranges::stable_sort(order, std::ranges::greater(), [&](std::size_t pose) { return margins[pose]; });
  order.resize(static_cast<std::size_t>(std::lround(share * static_cast<double>(order.size()))));
  for (const std::size_t pose : order) chosen[pose] = best[pose];
  return chosen;
}

std::vector<std::int32_t> view_sets(const ViewDataset& dataset, std::span<const double> scores, Index count) {
  std::vector<std::int32_t> views = best_views(dataset, scores, count);
  std::vector<view::CameraPose> poses;
  std::vector<std::size_t> chosen(static_cast<std::size_t>(count));
  std::vector<double> nearest;
  for (std::size_t p = 0; p < dataset.poses.size(); ++p) {
    const auto& pose = dataset.poses[p];
    poses.clear();
    for (const View& view : dataset.views_of(static_cast<Index>(p)))
      poses.push_back({static_cast<double>(view.theta_deg), static_cast<double>(view.phi_deg)});
    const std::size_t found = choose_view_set(
        poses, [&](std::size_t i) { return scores[static_cast<std::size_t>(pose.first_view) + i]; }, {}, chosen,
        nearest);
    for (std::size_t i = 0; i < chosen.size() && found > 0; ++i)
      views[p * chosen.size() + i] = static_cast<std::int32_t>(pose.first_view + static_cast<Index>(chosen[i % found]));
  }
  return views;
}

namespace {

/// The scores without those of some views, which are not chosen again.
std::vector<double> without(std::span<const double> scores, std::span<const std::int32_t> views) {
  std::vector<double> rest(scores.begin(), scores.end());
  for (const std::int32_t view : views) rest[static_cast<std::size_t>(view)] = std::numeric_limits<double>::quiet_NaN();
  return rest;
}

/// Puts `more` views of each pose after `count` of each.
std::vector<std::int32_t> appended(std::span<const std::int32_t> views, Index count,
                                   std::span<const std::int32_t> others, Index more) {
  std::vector<std::int32_t> all;
  for (std::size_t i = 0, j = 0; i < views.size(); i += static_cast<std::size_t>(count)) {
    all.insert(all.end(), views.begin() + static_cast<std::ptrdiff_t>(i),
               views.begin() + static_cast<std::ptrdiff_t>(i) + count);
    for (Index k = 0; k < more; ++k) all.push_back(others[j++]);
  }
  return all;
}

}  // namespace

std::vector<std::int32_t> views_after(const ViewDataset& dataset, const std::vector<std::int32_t>& first,
                                      const NextScores& next, Index count) {
  check(next != nullptr,
        "evaluation.selectors: the model does not know which view to take next; train it with sv_net.next_view: ridge");
  std::vector<std::int32_t> views = first;
  for (Index taken = 1; taken < count; ++taken)
    views = appended(views, taken, best_views(dataset, without(next(views, taken), views)), 1);
  return views;
}

std::vector<std::int32_t> views_beside(const ViewDataset& dataset, const std::vector<std::int32_t>& first,
                                       std::span<const double> scores, Index count) {
  if (count == 1) return first;
  return appended(first, 1, view_sets(dataset, without(scores, first), count - 1), count - 1);
}

}  // namespace svnet::train
