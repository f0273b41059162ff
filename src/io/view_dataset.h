#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/index.h"
#include "base/parallel.h"

// Data sets of views on disk: ROOT/category/object/pose/PHI_THETA.png (or .jpg, .jpeg, .webp, in any case), angles in
// whole degrees, φ in [0, 90] and θ in [0, 359]; the top view is 90_90. Folder names are free. Names that begin with
// '_' or '.' are ignored at every level, and so are plain files beside the categories (manifest.json).
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

/// Whether a file or folder of that name, in whatever place, is none of the data set: it begins with '_' or '.'.
bool is_ignored_name(const std::filesystem::path& name);

/// Reads the names, not the pictures. Throws Error that names the file or folder for anything that does not fit: a name
/// that is no view, an angle out of range, the same view twice, a pose without its top view, an empty folder.
ViewDataset read_view_dataset(const std::filesystem::path& root);

/// 64 hexadecimal digits that change with any path or content: the SHA-256 of every view's path and the SHA-256 of its
/// file, in byte order of the paths. The root and the order of reading do not enter.
std::string fingerprint(const ViewDataset&, Parallel&);

}  // namespace svnet
