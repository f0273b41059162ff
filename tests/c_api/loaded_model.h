#pragma once
#include <catch2/catch.hpp>
#include <vector>

#include "small_model.h"
#include "svnet/svnet.h"
#include "temporary_folder.h"
#include "view/camera_pose.h"

/// A model in the shared library, from a file that is gone afterwards.
struct Loaded {
  explicit Loaded(const svnet::Model& written = small_model()) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "model.safetensors";
    svnet::io::write_model(path, written);
    REQUIRE(svnet_model_load(path.c_str(), &model) == SVNET_OK);
  }
  ~Loaded() { svnet_model_free(model); }
  Loaded(const Loaded&) = delete;
  Loaded& operator=(const Loaded&) = delete;

  std::vector<float> embed(const std::vector<std::uint8_t>& pixels, std::int32_t height, std::int32_t width,
                           std::size_t stride, svnet_pixel_format format) const {
    std::vector<float> features(svnet_feature_count(model));
    REQUIRE(svnet_embed(model, pixels.data(), height, width, stride, format, features.data()) == SVNET_OK);
    return features;
  }

  svnet_model* model = nullptr;
};

inline std::vector<double> pairs_of(const std::vector<svnet::view::CameraPose>& poses) {
  std::vector<double> pairs;
  for (const auto& pose : poses) pairs.insert(pairs.end(), {pose.theta_deg, pose.phi_deg});
  return pairs;
}
