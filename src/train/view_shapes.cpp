#include "train/view_shapes.h"

#include <algorithm>

#include "base/error.h"
#include "base/parallel_progress.h"
#include "base/sha256.h"
#include "frame/next_inputs.h"
#include "io/images/image_file.h"

namespace svnet::train {
namespace {

frame::ViewShape shape_of(const std::filesystem::path& path, ExifOrientation orientation) {
  const Image image = io::read_image(path, orientation);
  try {
    return frame::view_shape(image);
  } catch (const Error& error) {
    fail(path.string(), ": ", error.what());
  }
}

}  // namespace

Features extract_view_shapes(const ViewDataset& dataset, const FeaturesOrigin& origin, const Messages& messages,
                             Parallel& parallel) {
  const auto count = static_cast<Index>(dataset.views.size());
  Features features{origin, count, static_cast<Index>(frame::kViewShapeSize), {}, {}, {}};
  for (const View& view : dataset.views) {
    features.theta_phi_deg.push_back({static_cast<double>(view.theta_deg), static_cast<double>(view.phi_deg)});
    features.paths.push_back(view.path);
  }
  features.values.resize(dataset.views.size() * frame::kViewShapeSize);
  for_each_with_progress(parallel, messages, "shapes of views", count, [&](Index v) {
    const View& view = dataset.views[static_cast<std::size_t>(v)];
    std::ranges::copy(
        shape_of(dataset.root / view.path, dataset.exif_orientation),
        features.values.begin() + static_cast<std::ptrdiff_t>(v * static_cast<Index>(frame::kViewShapeSize)));
  });
  return features;
}

FeaturesOrigin view_shapes_origin(const std::string& dataset_fingerprint) {
  return {.backbone = "silhouette",
          .output = "shape",
          .preprocessing = "none",
          .weights_sha256 = "none",
          .dataset_fingerprint = dataset_fingerprint,
          .input_fingerprint = Sha256().update_field("view shapes 1").update_field(dataset_fingerprint).hex()};
}

}  // namespace svnet::train
