#include "train/dataset_rows.h"

#include <catch2/catch.hpp>

using namespace svnet;
using namespace svnet::train;
using Catch::Contains;

namespace {

/// Two categories with two views each.
ViewDataset two_categories() {
  ViewDataset dataset;
  dataset.categories = {"cup", "mug"};
  for (Index c = 0; c < 2; ++c) {
    dataset.views.push_back({dataset.categories[static_cast<std::size_t>(c)] + "/1/1/45_0.png", c, c, c, 45, 0, false});
    dataset.views.push_back(
        {dataset.categories[static_cast<std::size_t>(c)] + "/1/1/90_90.png", c, c, c, 90, 90, true});
  }
  return dataset;
}

Features with_labels(std::vector<std::int64_t> labels) {
  Features features;
  features.theta_phi_deg = {{0, 45}, {90, 90}, {0, 45}, {90, 90}};
  features.labels = std::move(labels);
  return features;
}

}  // namespace

TEST_CASE("rows without paths are named by the views of the data set, if angles and labels fit") {
  const ViewDataset dataset = two_categories();
  Features features = with_labels({7, 7, 3, 3});
  name_rows(dataset, features, "f.h5");
  CHECK(features.paths[3] == "mug/1/1/90_90.png");

  features = with_labels({7, 7, 7, 3});
  CHECK_THROWS_WITH(name_rows(dataset, features, "f.h5"), Contains("f.h5: row 2 has the label 7"));
  features = with_labels({7, 3, 3, 3});
  CHECK_THROWS_WITH(name_rows(dataset, features, "f.h5"), Contains("f.h5: row 1 has the label 3"));
  features = with_labels({7, 7, 3});
  CHECK_THROWS_WITH(name_rows(dataset, features, "f.h5"), "f.h5: has 3 rows and no paths, the data set has 4 views");
  features = with_labels({7, 7, 3, 3});
  std::swap(features.theta_phi_deg[0], features.theta_phi_deg[1]);
  CHECK_THROWS_WITH(name_rows(dataset, features, "f.h5"),
                    Contains("f.h5: row 0 has the angles 90, 90, the view there is cup/1/1/45_0.png"));
}
