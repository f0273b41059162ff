#pragma once
#include <string>
#include <vector>

#include "data/view_dataset.h"

namespace svnet {

/// A dataset without files: categories "a", "b", … with so many objects each, of `poses` poses, each with the views
/// 90_90, 45_0 and 45_90.
inline ViewDataset made_up_dataset(const std::vector<Index>& objects, Index poses = 1) {
  ViewDataset dataset;
  for (std::size_t c = 0; c < objects.size(); ++c) {
    dataset.categories.emplace_back(1, static_cast<char>('a' + c));
    for (Index o = 0; o < objects[c]; ++o) {
      dataset.objects.push_back({std::to_string(o + 1), static_cast<Index>(c)});
      for (Index p = 0; p < poses; ++p) {
        const auto first = static_cast<Index>(dataset.views.size());
        const Index object = static_cast<Index>(dataset.objects.size()) - 1,
                    pose = static_cast<Index>(dataset.poses.size());
        dataset.poses.push_back({std::to_string(p + 1), object, static_cast<Index>(c), first, 3, first});
        for (const auto& [phi, theta] : {std::pair{90, 90}, std::pair{45, 0}, std::pair{45, 90}})
          dataset.views.push_back({"", static_cast<Index>(c), object, pose, phi, theta, phi == 90});
      }
    }
  }
  return dataset;
}

/// Features (views, 2): views from the side lie near the place of their category, top views are all alike but for a
/// little noise.
inline std::vector<float> telling_from_the_side(const ViewDataset& dataset) {
  std::vector<float> features;
  for (std::size_t v = 0; v < dataset.views.size(); ++v) {
    const View& view = dataset.views[v];
    const auto noise = static_cast<float>(v * 37 % 101) / 101;
    features.push_back((view.top ? 0 : 10 * static_cast<float>(view.category)) + noise);
    features.push_back(static_cast<float>(v * 53 % 89) / 89);
  }
  return features;
}

}  // namespace svnet
