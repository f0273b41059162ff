// svnet_paper_views FOLDER [VIEWS]: writes a dataset of the paper's size, for timing svnet-score.
// FOLDER/data: VIEWS views (default 7560, that is 5 objects per category) in 24 categories; an object has 3 poses of 21
// views. The files are not images, because scoring does not decode them.
// FOLDER/features.h5: 2048 features per view, drawn around the centre of its category.
#include <cstdlib>
#include <fstream>
#include <iostream>

#include "base/error.h"
#include "base/random.h"
#include "io/views/dataset_folder.h"
#include "io/views/features_file.h"

namespace svnet {
namespace {

constexpr Index kDimension = 2048;

void write_data(const std::filesystem::path& root, int views) {
  for (int pose = 0, left = views; left > 0; ++pose) {
    const int object = pose / 3;
    const auto folder = root / std::to_string(object % 24) / std::to_string(object / 24) / std::to_string(pose % 3);
    std::filesystem::create_directories(folder);
    int room = std::min(left, 21);
    left -= room;
    for (const int phi : {90, 45, 60, 75})
      for (const int theta : {90, 0, 45, 135, 180, 225, 315})
        if ((phi < 90 || theta == 90) && room-- > 0)
          std::ofstream(folder / (std::to_string(phi) + "_" + std::to_string(theta) + ".png")) << pose << " " << room;
  }
}

void write_paper_views(const std::filesystem::path& folder, int views) {
  write_data(folder / "data", views);
  const ViewDataset dataset = io::read_view_dataset(folder / "data");
  Features features{{.backbone = "random",
                     .output = "random",
                     .preprocessing = "none",
                     .weights_sha256 = "random, seed 1",
                     .dataset_fingerprint = io::fingerprint(dataset, Parallel::shared()),
                     .input_fingerprint = "svnet_paper_views 1"},
                    static_cast<Index>(dataset.views.size()),
                    kDimension,
                    {},
                    {},
                    {}};
  features.values.resize(static_cast<std::size_t>(features.count * kDimension));
  Parallel::shared().for_chunks(features.count, 16, [&](Index begin, Index end, int) {
    for (Index v = begin; v < end; ++v) {
      RandomStream centre(1, Stream::shuffle, static_cast<std::uint64_t>(dataset.views[v].category));
      RandomStream noise(1, Stream::weights, static_cast<std::uint64_t>(v));
      for (Index d = 0; d < kDimension; ++d)
        features.values[v * kDimension + d] = static_cast<float>(centre.normal() + 6 * noise.normal());
    }
  });
  for (const View& view : dataset.views) {
    features.theta_phi_deg.push_back({static_cast<double>(view.theta_deg), static_cast<double>(view.phi_deg)});
    features.paths.push_back(view.path);
  }
  io::write_features(folder / "features.h5", features);
}

}  // namespace
}  // namespace svnet

int main(int argc, char** argv) {
  const int views = argc > 2 ? std::atoi(argv[2]) : 7560;
  if (argc < 2 || argc > 3 || views < 1) {
    std::cerr << "usage: svnet_paper_views FOLDER [VIEWS]\n";
    return 2;
  }
  try {
    svnet::write_paper_views(argv[1], views);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "svnet_paper_views: " << error.what() << std::endl;
    return 1;
  }
}
