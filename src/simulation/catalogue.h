#pragma once
#include <span>
#include <string>
#include <vector>

#include "simulation/mesh.h"

namespace svnet::simulation {

/// The names of the categories of household objects and tools, in alphabetical order. The first kDesigns objects of a
/// category are designs; each further one mixes two of them at random.
const std::vector<std::string>& catalogue_names();

constexpr Index kDesigns = 5;

/// Object `object` (from 0) of a category, in metres, with normals. The seed matters only if object >= kDesigns. Throws
/// Error for an unknown category and suggests the nearest name.
Mesh catalogue_object(const std::string& category, Index object, std::uint64_t seed);

}  // namespace svnet::simulation
