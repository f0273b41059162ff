#pragma once
#include <string>
#include <vector>

#include "base/parallel.h"
#include "base/progress.h"
#include "data/view_dataset.h"
#include "frame/top_frame.h"

namespace svnet::train {

/// What a head in the frames `axis` and `turned_axis` sees of every pose of a dataset, in its order: the rounding of
/// the floats included, so that training sees what prediction will see.
std::vector<frame::TopFrame> top_frames(const ViewDataset& dataset, frame::DepthChoice depth, const Messages& messages,
                                        Parallel& parallel);

/// The depth image of the top view of a pose: _extra/<folders of the pose>/90_90_depth.png or .npy below the dataset's
/// root. Throws Error that names the file if there is none.
std::filesystem::path top_depth_file(const ViewDataset& dataset, Index pose);

/// Changes with every value of the frames.
std::string fingerprint(const std::vector<frame::TopFrame>& frames);

}  // namespace svnet::train
