#include "train/top_frames.h"

#include "base/error.h"
#include "base/parallel_progress.h"
#include "base/sha256.h"
#include "io/images/depth_file.h"
#include "io/images/image_file.h"
#include "io/views/dataset_folder.h"

namespace svnet::train {
namespace {

frame::TopFrame frame_of(const ViewDataset& dataset, Index pose, frame::DepthChoice depth) {
  const auto path = dataset.root / dataset.views[static_cast<std::size_t>(dataset.top_view(pose))].path;
  const Image image = io::read_image(path, dataset.exif_orientation);
  try {
    if (depth == frame::DepthChoice::none) return frame::top_frame(image);
    const DepthImage measured = io::read_depth(top_depth_file(dataset, pose));
    return frame::top_frame(image, &measured);
  } catch (const Error& error) {
    fail(path.string(), ": ", error.what());
  }
}

}  // namespace

std::filesystem::path top_depth_file(const ViewDataset& dataset, Index pose) {
  if (const auto found = io::find_top_depth(dataset, pose)) return *found;
  const std::filesystem::path image = dataset.views[static_cast<std::size_t>(dataset.top_view(pose))].path;
  fail((dataset.root / "_extra" / image.parent_path() / (image.stem().string() + "_depth.png")).string(),
       ": no such file; sv_net.depth: heights needs the depth image of every top view, set it to none without them");
}

std::vector<frame::TopFrame> top_frames(const ViewDataset& dataset, frame::DepthChoice depth, const Messages& messages,
                                        Parallel& parallel) {
  std::vector<frame::TopFrame> frames(dataset.poses.size());
  for_each_with_progress(parallel, messages, "frames of top views", static_cast<Index>(frames.size()), [&](Index pose) {
    frames[static_cast<std::size_t>(pose)] = frame::from_values(frame::to_values(frame_of(dataset, pose, depth)));
  });
  return frames;
}

std::string fingerprint(const std::vector<frame::TopFrame>& frames) {
  Sha256 hash;
  hash.update_field("frames 1");
  for (const frame::TopFrame& frame : frames) {
    const frame::TopFrameValues values = frame::to_values(frame);
    hash.update_field(std::string_view(reinterpret_cast<const char*>(values.data()), sizeof values));
  }
  return hash.hex();
}

}  // namespace svnet::train
