#pragma once
#include <vector>

#include "base/parallel.h"
#include "frame/frame_choice.h"
#include "report/run_report.h"
#include "report/stored_results.h"

namespace svnet::report {

/// The held-out poses of a dataset, in its order, without pictures. Requires a prediction per view of the dataset.
/// `of_dataset` receives the index of each in the dataset.
std::vector<ShownPose> shown_poses(const ViewDataset& dataset, const std::vector<ViewPrediction>& predictions,
                                   std::vector<Index>& of_dataset);

/// Which poses become figures: the first pose of the first object of a dozen categories, spread evenly over them; with
/// fewer categories, of their next objects too.
std::vector<std::size_t> figure_poses(const std::vector<ShownPose>& poses);

/// Reads the images of the figures and of the first pose of each object, as long as all of them stay small enough for
/// one page, and measures the axes of the figures. `depth`: whether the axis is measured in depth. Throws Error that
/// names an image that cannot be read.
void add_pictures(const ViewDataset& dataset, const std::vector<Index>& of_dataset, frame::DepthChoice depth,
                  std::vector<ShownPose>& poses, Parallel& parallel);

}  // namespace svnet::report
