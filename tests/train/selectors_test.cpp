#include "train/selectors.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace svnet;
using namespace svnet::train;

namespace {

struct Angles {
  int phi_deg, theta_deg;
};

/// One category of objects with one pose each and these views; 90_90 is the top view.
ViewDataset dataset_of(const std::vector<std::vector<Angles>>& poses) {
  ViewDataset dataset;
  dataset.categories = {"a"};
  for (std::size_t p = 0; p < poses.size(); ++p) {
    const auto pose = static_cast<Index>(p), first = static_cast<Index>(dataset.views.size());
    dataset.objects.push_back({"o", 0});
    dataset.poses.push_back({"1", pose, 0, first, static_cast<Index>(poses[p].size()), first});
    for (const Angles& angles : poses[p]) {
      const bool top = angles.phi_deg == 90;
      if (top) dataset.poses.back().top_view = static_cast<Index>(dataset.views.size());
      dataset.views.push_back({"x", 0, pose, pose, angles.phi_deg, angles.theta_deg, top});
    }
  }
  return dataset;
}

frame::TopFrame along(double direction_deg, frame::AxisKind kind = frame::AxisKind::found) {
  return {.axis = {.kind = kind, .direction_deg = direction_deg}, .heights = {}};
}

const std::vector<Angles> kViews{{45, 0}, {45, 45}, {45, 90}, {45, 135}, {60, 0}, {60, 90}, {90, 90}};

}  // namespace

TEST_CASE("broadside looks at 45 degrees across the object's axis") {
  const ViewDataset dataset = dataset_of({kViews, kViews, kViews, kViews});
  // Along 0 and 180 the view from 90 is across, along 93 that from 0, along 220 that from 135.
  const std::vector<frame::TopFrame> frames{along(0), along(180), along(93), along(220)};
  CHECK(broadside_views(dataset, frames) == std::vector<std::int32_t>{2, 7 + 2, 14 + 0, 21 + 3});
}

TEST_CASE("broadside weighs elevation against azimuth, and never prefers the top view to a view near it") {
  // 15 degrees too high and across, against 45 degrees off the plane across.
  const std::vector<Angles> views{{45, 45}, {60, 90}, {90, 90}};
  CHECK(broadside_views(dataset_of({views}), std::vector{along(0)}) == std::vector<std::int32_t>{1});
  const std::vector<Angles> only_along{{45, 0}, {90, 90}};  // 90 degrees off; the top view is 45 too high
  CHECK(broadside_views(dataset_of({only_along}), std::vector{along(0)}) == std::vector<std::int32_t>{1});
}

TEST_CASE("broadside takes the first of the views at 45 degrees if there is no axis or a tie") {
  const ViewDataset dataset = dataset_of({kViews, kViews});
  const std::vector<frame::TopFrame> frames{along(0, frame::AxisKind::round), along(90, frame::AxisKind::unclear)};
  CHECK(broadside_views(dataset, frames) == std::vector<std::int32_t>{0, 7});
  const std::vector<Angles> both_sides{{45, 90}, {45, 270}, {90, 90}};
  CHECK(broadside_views(dataset_of({both_sides}), std::vector{along(0)}) == std::vector<std::int32_t>{0});
}

TEST_CASE("phi_map takes a view at the elevation with the best mean score within poses") {
  const double nan = std::nan("");
  const std::vector<Angles> views{{45, 0}, {45, 90}, {60, 0}, {90, 90}};
  const ViewDataset dataset = dataset_of({views, views, {{45, 0}, {90, 90}}});
  // 45 degrees is best within the first pose and the second; the level of a pose does not matter.
  CHECK(phi_map_views(dataset, std::vector{0.5, 0.4, 0.3, 0.1, 0.95, 0.85, 0.8, 0.9, nan, nan}) ==
        std::vector<std::int32_t>{0, 4, 8});
  // 60 degrees is best, which the third pose does not have: then the second best.
  CHECK(phi_map_views(dataset, std::vector{0.3, 0.3, 0.9, 0.1, 0.3, 0.3, 0.9, 0.2, nan, nan}) ==
        std::vector<std::int32_t>{2, 6, 8});
  // Views without a score do not count.
  CHECK(phi_map_views(dataset, std::vector{nan, 0.2, 0.4, 0.3, nan, nan, nan, nan, nan, nan}) ==
        std::vector<std::int32_t>{2, 6, 9});
}

TEST_CASE("phi_map is not misled by a pose of high scores that lacks an elevation") {
  const ViewDataset dataset = dataset_of({{{45, 0}, {60, 0}, {90, 90}}, {{60, 0}, {90, 90}}});
  CHECK(phi_map_views(dataset, std::vector{0.5, 0.4, 0.3, 0.9, 0.9}) == std::vector<std::int32_t>{0, 3});
}

TEST_CASE("phi_map takes the first view of equal ones, and top views if there are no scores at all") {
  const std::vector<Angles> views{{45, 0}, {60, 0}, {90, 90}};
  const ViewDataset dataset = dataset_of({views, views});
  CHECK(phi_map_views(dataset, std::vector(6, 0.5)) == std::vector<std::int32_t>{0, 3});
  CHECK(phi_map_views(dataset, std::vector(6, std::nan(""))) == std::vector<std::int32_t>{2, 5});
}

TEST_CASE("of several views, those with the best scores are taken, and SV-net's also differ") {
  const ViewDataset dataset = dataset_of({kViews});
  std::vector<double> scores(dataset.views.size(), 0.0);
  const double nan = std::nan("");
  scores[1] = 0.8, scores[2] = 0.9;
  CHECK(best_views(dataset, scores, 2) == std::vector<std::int32_t>{2, 1});
  CHECK(view_sets(dataset, scores, 1) == std::vector<std::int32_t>{2});
  CHECK(view_sets(dataset, scores, 2)[0] == 2);
  scores.assign(scores.size(), nan);
  scores[3] = 0.5;
  CHECK(best_views(dataset, scores, 3) == std::vector<std::int32_t>{3, 3, 3});
  CHECK(view_sets(dataset, scores, 2) == std::vector<std::int32_t>{3, 3});
  scores[3] = nan;
  CHECK(best_views(dataset, scores, 2) == std::vector<std::int32_t>(2, top_views(dataset)[0]));
  CHECK(view_sets(dataset, scores, 2) == std::vector<std::int32_t>(2, top_views(dataset)[0]));
}

TEST_CASE("the rules are selectors that a configuration names") {
  const auto kinds = selectors_of_table({"broadside", "phi_map"}, Split::held_out);
  REQUIRE(kinds.size() == 2);
  const ViewDataset dataset = dataset_of({kViews});
  Scores scores;
  scores.individual = {0, 0, 0, 0, 1, 1, 0};
  const std::vector<frame::TopFrame> frames{along(0)};
  const std::vector<double> predicted(7, 0);
  const SelectorInputs inputs{.dataset = dataset,
                              .scores = [] { return ViewScores{}; },
                              .predicted = predicted,
                              .training_scores = scores,
                              .frames = [&]() -> const std::vector<frame::TopFrame>& { return frames; }};
  CHECK(kinds[0]->view(inputs, 1) == std::vector<std::int32_t>{2});
  CHECK(kinds[1]->view(inputs, 1) == std::vector<std::int32_t>{4});
  CHECK_THROWS_WITH(selectors_of_table({"broadsides"}, Split::held_out),
                    "evaluation.selectors: there is no selector 'broadsides', did you mean 'broadside'?");
}
