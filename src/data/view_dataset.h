#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/exif_orientation.h"
#include "base/index.h"

namespace svnet {

/// One image of a pose. category, object and pose are indices into the dataset's lists.
struct View {
  std::string path;  // relative to the root, with '/'
  Index category;
  Index object;
  Index pose;
  int phi_deg;
  int theta_deg;
  bool top;  // whether it is the top view 90_90 of its pose
};

/// The categories, objects, poses and views of a dataset. Each list is sorted by parent, then by name in natural order,
/// so that the views of a pose, the poses of an object and so on are contiguous.
struct ViewDataset {
  struct Object {
    std::string name;
    Index category;
  };
  /// One placement of an object on the table, with its views: views[first_view, first_view + view_count).
  struct Pose {
    std::string name;
    Index object;
    Index category;
    Index first_view;
    Index view_count;
    Index top_view;
  };

  std::filesystem::path root;
  /// How the views' pixels are read.
  ExifOrientation exif_orientation = ExifOrientation::ignore;
  /// Files and folders that other programs left and that were passed over, and files beside the categories. Relative to
  /// the root.
  std::vector<std::string> ignored;
  std::vector<std::string> categories;  // in Unicode's composed form (NFC)
  std::vector<Object> objects;
  std::vector<Pose> poses;
  std::vector<View> views;

  /// The index of the top view of a pose.
  Index top_view(Index pose) const { return poses[static_cast<std::size_t>(pose)].top_view; }
  std::span<const View> views_of(Index pose) const;
  /// The pose of every view.
  std::vector<std::int32_t> pose_of_view() const;
  /// The path of a pose for messages, such as "mug/2/1".
  std::string pose_path(Index pose) const;
};

/// The categories for which `wanted` is true, with their objects, poses and views, in the same order. Requires an
/// element per category.
ViewDataset with_categories(const ViewDataset& dataset, const std::vector<bool>& wanted);

}  // namespace svnet
