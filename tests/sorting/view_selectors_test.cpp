#include "sorting/view_selectors.h"

#include <catch2/catch.hpp>

#include "base/error.h"
#include "io/views/dataset_folder.h"
#include "made_up_dataset.h"
#include "small_dataset.h"
#include "small_model.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::sorting;

namespace {

std::vector<std::string> names_of_selectors(const std::vector<train::Selector>& selectors) {
  std::vector<std::string> names;
  for (const train::Selector& selector : selectors) names.push_back(selector.name);
  return names;
}

}  // namespace

TEST_CASE("selectors choose by rules, by predictions and by semantic scores") {
  const TemporaryFolder folder;
  write_small_dataset(folder.path());
  const ViewDataset dataset = io::read_view_dataset(folder.path());
  Parallel parallel(2);
  std::vector<float> features;  // views at 45 degrees tell the category
  std::vector<double> predicted;
  for (const View& view : dataset.views) {
    const auto noise = static_cast<float>(features.size() * 37 % 101) / 50;
    features.push_back((view.phi_deg == 45 ? 10 * static_cast<float>(view.category + 1) : 0) + noise);
    predicted.push_back(view.phi_deg == 75 ? 1 : 0);
  }
  const auto without = view_selectors(dataset, features, {}, 1, {}, parallel);
  CHECK(names_of_selectors(without) == std::vector<std::string>{"top", "rand", "broadside", "opt"});
  const auto with = view_selectors(dataset, features, predicted, 1, {}, parallel);
  REQUIRE(names_of_selectors(with) ==
          std::vector<std::string>{"top", "rand", "broadside", "svnet", "top_svnet", "move_50", "svnet_2", "opt"});
  CHECK(with[1].view.empty());
  for (std::size_t p = 0; p < dataset.poses.size(); ++p) {
    const auto chosen = [&](std::size_t selector, std::size_t view = 0) {
      return dataset.views[static_cast<std::size_t>(
          with[selector].view[p * static_cast<std::size_t>(with[selector].views) + view])];
    };
    CHECK(chosen(0).top);
    CHECK(chosen(3).phi_deg == 75);
    CHECK(chosen(4).top);
    CHECK(chosen(4, 1).phi_deg == 75);
    CHECK((chosen(5).phi_deg == 75 || chosen(5).top));
    CHECK(chosen(6).phi_deg == 75);
    CHECK(chosen(6, 1).phi_deg != 75);
    CHECK(chosen(7).phi_deg == 45);
  }
}

TEST_CASE("predicted scores are those of the predictor, for any number of threads") {
  const TemporaryFolder folder;
  write_small_dataset(folder.path());
  const ViewDataset dataset = io::read_view_dataset(folder.path());
  const predict::Predictor predictor(small_model());
  Parallel one(1), three(3);
  const std::vector<double> scores = predicted_scores(dataset, predictor, {}, one);
  CHECK(scores == predicted_scores(dataset, predictor, {}, three));
  REQUIRE(scores.size() == dataset.views.size());
  const Tensor features = predictor.embed(
      io::read_image(folder.path() / dataset.views[static_cast<std::size_t>(dataset.top_view(3))].path));
  const View& view = dataset.views[static_cast<std::size_t>(dataset.poses[3].first_view) + 1];
  const view::CameraPose pose{static_cast<double>(view.theta_deg), static_cast<double>(view.phi_deg)};
  CHECK(scores[static_cast<std::size_t>(dataset.poses[3].first_view) + 1] ==
        predictor.scores(features, std::span(&pose, 1))[0]);
}

TEST_CASE("predictions name the depth image that is missing") {
  const TemporaryFolder folder;
  write_small_dataset(folder.path());
  Parallel one(1);
  CHECK_THROWS_WITH(predicted_scores(io::read_view_dataset(folder.path()),
                                     predict::Predictor(small_axis_model(frame::DepthChoice::heights)), {}, one),
                    Catch::Contains("_extra/ball/0/1/90_90_depth.png: no such file"));
}
