#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "base/parallel.h"
#include "data/view_dataset.h"

// A dataset on disk: ROOT/category/object/pose/PHI_THETA.png (or .jpg, .jpeg, .webp, in upper or lower case). Angles
// are whole degrees, φ in [0, 90] and θ in [0, 359]; the top view is 90_90. Folders may have any name. Names that begin
// with '_' or '.' are ignored at every level, and so are names that systems leave beside images (Thumbs.db,
// desktop.ini, @eaDir, .DS_Store, lost+found), and files beside the category folders (manifest.json). Names of
// categories are compared in Unicode's composed form.
namespace svnet::io {

/// Whether datasets ignore files and folders of that name: it begins with '_' or '.', or systems leave it.
bool is_ignored_name(const std::filesystem::path& name);

/// Reads the names of files and folders, not the images. Throws Error that names the file or folder if it does not
/// belong there: not a view, an angle out of range, a view that exists twice, a pose without top view, an empty folder.
ViewDataset read_view_dataset(const std::filesystem::path& root,
                              ExifOrientation exif_orientation = ExifOrientation::ignore);

/// The depth image of the top view of a pose, _extra/<folders of the pose>/90_90_depth.png or .npy below the dataset's
/// root, if there is one.
std::optional<std::filesystem::path> find_top_depth(const ViewDataset&, Index pose);

/// A SHA-256 over the path and the SHA-256 of every view's file, sorted by path: 64 hexadecimal digits. It does not
/// depend on the root. It is another one if EXIF orientation is obeyed.
std::string fingerprint(const ViewDataset&, Parallel&);

}  // namespace svnet::io
