#pragma once
#include <filesystem>
#include <string>

#include "base/parallel.h"
#include "data/view_dataset.h"

// Data sets of views on disk: ROOT/category/object/pose/PHI_THETA.png (or .jpg, .jpeg, .webp, in any case), angles in
// whole degrees, φ in [0, 90] and θ in [0, 359]; the top view is 90_90. Folder names are free. Names that begin with
// '_' or '.' are ignored at every level, and so are plain files beside the categories (manifest.json).
namespace svnet {

/// Whether a file or folder of that name, in whatever place, is none of the data set: it begins with '_' or '.'.
bool is_ignored_name(const std::filesystem::path& name);

/// Reads the names, not the pictures. Throws Error that names the file or folder for anything that does not fit: a name
/// that is no view, an angle out of range, the same view twice, a pose without its top view, an empty folder.
ViewDataset read_view_dataset(const std::filesystem::path& root);

/// 64 hexadecimal digits that change with any path or content: the SHA-256 of every view's path and the SHA-256 of its
/// file, in byte order of the paths. The root and the order of reading do not enter.
std::string fingerprint(const ViewDataset&, Parallel&);

}  // namespace svnet
