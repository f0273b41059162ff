#pragma once
#include <string>

#include "base/random.h"
#include "data/view_dataset.h"
#include "io/views/dataset_folder.h"
#include "io/views/features_file.h"
#include "temporary_folder.h"

namespace svnet {

/// A dataset whose files are not images (scoring does not decode them), and its features in features.h5:
/// `categories` categories of `objects` objects in one pose of `views` views.
inline void write_views(const TemporaryFolder& folder, int categories, int objects, int views, Index dimension) {
  constexpr int kThetas[] = {0, 45, 90, 135, 180, 225, 315}, kPhis[] = {45, 60, 75};
  for (int c = 0; c < categories; ++c)
    for (int o = 0; o < objects; ++o) {
      const std::string pose = "data/category" + std::to_string(c) + "/" + std::to_string(o) + "/1/";
      folder.write(pose + "90_90.png", pose);
      for (int v = 0; v + 1 < views; ++v)
        folder.write(pose + std::to_string(kPhis[v / 7]) + "_" + std::to_string(kThetas[v % 7]) + ".png", pose);
    }
  const ViewDataset dataset = io::read_view_dataset(folder.path() / "data");
  Features features{{.backbone = "none",
                     .output = "none",
                     .preprocessing = "none",
                     .weights_sha256 = "none",
                     .dataset_fingerprint = io::fingerprint(dataset, Parallel::shared()),
                     .input_fingerprint = "made for a test"},
                    static_cast<Index>(dataset.views.size()),
                    dimension,
                    {},
                    {},
                    {}};
  RandomStream random(5, Stream::shuffle);
  std::vector<float> centres(static_cast<std::size_t>(categories * dimension));
  for (auto& value : centres) value = static_cast<float>(random.normal());
  for (const View& view : dataset.views) {
    for (Index d = 0; d < dimension; ++d)
      features.values.push_back(centres[static_cast<std::size_t>(view.category * dimension + d)] +
                                1.5f * static_cast<float>(random.normal()));
    features.theta_phi_deg.push_back({static_cast<double>(view.theta_deg), static_cast<double>(view.phi_deg)});
    features.paths.push_back(view.path);
  }
  io::write_features(folder.path() / "features.h5", features);
}

}  // namespace svnet
