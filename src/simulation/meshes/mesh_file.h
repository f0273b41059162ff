#pragma once
#include <filesystem>

#include "simulation/mesh.h"

namespace svnet {

/// Whether a file's name ends like that of a mesh: .obj, .ply, .stl or .glb, in small or capital letters.
bool is_mesh_name(const std::filesystem::path& path);

/// A mesh with its colours and textures (OBJ, PLY, STL or GLB; textures embedded or beside the file), `metres_per_unit`
/// long per unit, with normals. Throws Error, one line that names the file, where it cannot be read, is cut off, holds
/// no triangles or numbers that are not finite, is larger than 5 million triangles, or a texture cannot be read.
Mesh read_mesh(const std::filesystem::path& path, double metres_per_unit = 1);

}  // namespace svnet
