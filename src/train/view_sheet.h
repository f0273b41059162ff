#pragma once
#include <span>
#include <vector>

#include "image/image.h"
#include "train/selectors.h"

namespace svnet::train {

/// A contact sheet of views: for each pose a group with the view that each selector chooses, and below each view the
/// selector's name and the view's elevation and azimuth. Each category begins a line. Reads the images. Requires:
/// every selector has a view for each of the poses.
Image view_sheet(const ViewDataset& dataset, std::span<const Index> poses, std::span<const Selector> selectors);

/// As many poses as fit on a sheet: the first pose of the first objects of the first `wanted` categories.
std::vector<Index> sheet_poses(const ViewDataset& dataset, const std::vector<bool>& wanted);

}  // namespace svnet::train
