#pragma once
#include <filesystem>

#include "data/features.h"

namespace svnet::io {

// The HDF5 datasets are `features` (N, D) float32, `th_ph` (N, 2) float64 in degrees, and `paths` (N) UTF-8. The
// attributes of the root have the names of the members of FeaturesOrigin. If the first parts of all paths are folders,
// `labels` (N) int64 are their numbers, in order of appearance: for programs that know the datasets `features`, `th_ph`
// and `labels` alone. Files of such programs are read too: without `paths` and attributes, but with `labels`.

/// Throws Error that names the file, the HDF5 dataset and the row unless the shapes agree, there is at least one value,
/// and all values are finite.
Features read_features(const std::filesystem::path& path);

/// Where the features of a file come from, without reading them. Throws Error that names the file and the attribute.
FeaturesOrigin read_features_origin(const std::filesystem::path& path);

/// Replaces the file as a whole. Throws Error for features that read_features would refuse.
void write_features(const std::filesystem::path& path, const Features& features);

}  // namespace svnet::io
