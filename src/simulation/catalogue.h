#pragma once
#include <span>
#include <string>
#include <vector>

#include "simulation/mesh.h"

namespace svnet {

/// The categories of household objects and tools that can be made, in alphabetical order. The first five objects of
/// each are designs; further ones are mixtures of two of them.
const std::vector<std::string>& catalogue_names();

constexpr Index kDesigns = 5;

/// Object number `object` (from 0) of a category, in metres, with normals; the same for every seed where object <
/// kDesigns. Throws Error for an unknown category, with the nearest one.
Mesh catalogue_object(const std::string& category, Index object, std::uint64_t seed);

}  // namespace svnet
