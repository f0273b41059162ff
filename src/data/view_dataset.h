#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/index.h"

namespace svnet {

struct View {
  std::string path;  // relative to the root, with '/'
  Index category;
  Index object;
  Index pose;
  int phi_deg;
  int theta_deg;
  bool top;
};

/// Categories, objects, poses and views are numbered from 0 over the whole data set, in natural order of their names
/// within their parents, so that what belongs together is contiguous.
struct ViewDataset {
  struct Object {
    std::string name;
    Index category;
  };
  struct Pose {
    std::string name;
    Index object;
    Index category;
    Index first_view;
    Index view_count;
    Index top_view;
  };

  std::filesystem::path root;
  std::vector<std::string> categories;
  std::vector<Object> objects;
  std::vector<Pose> poses;
  std::vector<View> views;

  /// The number of the top view of a pose.
  Index top_view(Index pose) const { return poses[static_cast<std::size_t>(pose)].top_view; }
  std::span<const View> views_of(Index pose) const;
  /// "mug/2/1", for messages.
  std::string pose_path(Index pose) const;
};

}  // namespace svnet
