#pragma once
#include <string>
#include <vector>

#include "base/parallel.h"
#include "data/view_dataset.h"

namespace svnet::io {

/// What somebody should know about a dataset that can be used all the same, a line each: how many files and folders
/// were ignored, and how many images have an EXIF orientation that is ignored. Reads every image's file.
std::vector<std::string> dataset_notes(const ViewDataset&, Parallel&);

/// The line for `turned` of `total` images whose EXIF orientation is not 1; `first` is one of them, `how` says how to
/// obey it.
std::string exif_note(const std::string& first, int orientation, Index turned, Index total, const std::string& how);

}  // namespace svnet::io
