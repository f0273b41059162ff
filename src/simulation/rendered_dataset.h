#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "simulation/catalogue.h"

// A dataset of views in simulation, as a robot with an RGB-D camera would collect it. In the folder:
//   CATEGORY/OBJECT/POSE/PHI_THETA.png  the views
//   manifest.json                       {"program", "seed", "size_px", "left_out": {category: {object: {pose: why}}},
//                                       "poses": {category: {object: {pose: {"centre_m", "length_m", "width_m",
//                                       "height_m", "radius_m", "tries", "views"}}}}}
//   _extra/CATEGORY/OBJECT/POSE/        overview(_background)(_depth).png, PHI_THETA_depth.png, PHI_THETA_mask.png
//   _extra/                             contact_sheet.png, overview_camera.json, view_camera.json
namespace svnet::simulation {

struct RenderOptions {
  std::filesystem::path output;         // must not exist or be an empty folder
  std::filesystem::path meshes;         // render the meshes of this folder; empty: the catalogue
  std::vector<std::string> categories;  // empty: all
  Index objects = kDesigns;             // of each category of the catalogue
  Index poses = 3;                      // of each object
  Index size = 224;                     // height and width of the views in pixels
  std::uint64_t seed = 1;
  std::optional<double> metres_per_unit{};  // of the meshes; none: by the size of each
};

struct RenderSummary {
  Index images = 0, poses = 0;                  // rendered
  Index left_out = 0;                           // poses that could not be collected, of objects that could be used
  Index objects = 0;                            // that were asked for
  std::vector<std::string> objects_left_out{};  // "CATEGORY/OBJECT"
};

/// Renders the dataset with the shared thread pool. The result depends on the options alone, not on the number of
/// threads. Reports progress, what is missing, and objects and poses that are left out: a mesh that cannot be used
/// costs its own object only. Throws Error for options that do not fit together, or if no pose was collected; then
/// there is no output folder.
RenderSummary render_dataset(const RenderOptions&, const Messages&);

}  // namespace svnet::simulation
