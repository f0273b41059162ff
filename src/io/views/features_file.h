#pragma once
#include <filesystem>

#include "data/features.h"

namespace svnet {

// HDF5. Datasets: `features` (N, D) float32, `th_ph` (N, 2) float64, degrees, `paths` (N) UTF-8. Attributes of the
// root: the members of FeaturesOrigin, by these names.

/// Throws Error that names the file, the dataset and the row unless shapes agree, there is at least one value and all
/// are finite.
Features read_features(const std::filesystem::path& path);

/// Replaces the file as a whole. Throws Error where read_features would.
void write_features(const std::filesystem::path& path, const Features& features);

}  // namespace svnet
