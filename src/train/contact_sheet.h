#pragma once
#include <span>

#include "image/image.h"
#include "train/evaluation.h"

namespace svnet {

/// Pictures of poses, for the eye: a group for each pose with the view that each selector chooses, below it the
/// selector's name and the view's elevation and azimuth; a line of groups, or several, for each category. Every
/// selector must have a view for each of the poses.
Image contact_sheet(const ViewDataset& dataset, std::span<const Index> poses, std::span<const Selector> selectors);

/// The first poses of the first objects of the first categories that are `wanted`: as many as fit a sheet.
std::vector<Index> sheet_poses(const ViewDataset& dataset, const std::vector<bool>& wanted);

}  // namespace svnet
