#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/index.h"

namespace svnet {

/// Where features come from.
struct FeaturesOrigin {
  std::string backbone;             // the model's name
  std::string output;               // the layer whose output they are
  std::string preprocessing;        // how an image becomes the model's input
  std::string weights_sha256;       // of the weights file
  std::string dataset_fingerprint;  // of the images
  std::string input_fingerprint;    // of everything that the values depend on: equal fingerprints mean equal features
};

/// The features of every image of a dataset; row i belongs to paths[i].
struct Features : FeaturesOrigin {
  Index count = 0;
  Index dimension = 0;
  std::vector<float> values;                         // (count, dimension)
  std::vector<std::array<double, 2>> theta_phi_deg;  // (count)
  std::vector<std::string> paths;                    // (count) as the dataset names its images
  /// (count), or empty: the category of each row, in files that name no paths.
  std::vector<std::int64_t> labels{};
};

}  // namespace svnet
