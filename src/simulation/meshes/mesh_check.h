#pragma once
#include "simulation/mesh.h"

namespace svnet::simulation {

/// The most triangles of a mesh that is read, and the most pixels of all its images.
inline constexpr std::size_t kMostTriangles = 5'000'000;
inline constexpr Index kMostTexturePixels = 4 * kMostPixels;

/// Whether a mesh is what a reader of meshes makes: it has triangles, all indices are in range, lists have the lengths
/// that mesh.h says, images their pixels, and numbers are finite.
bool is_consistent(const Mesh&);

}  // namespace svnet::simulation
