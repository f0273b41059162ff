#pragma once
#include <filesystem>
#include <functional>

#include "mesh_files.h"
#include "simulation/mesh.h"

namespace svnet::simulation {

/// A mesh that a child process decodes, which has the open file, what it asks for by name if `files` finds it, and
/// nothing else (sandbox/child.h). What it answers is checked. Throws Error as decode_mesh does.
Mesh read_mesh_elsewhere(const std::filesystem::path& path, const MeshFiles& files,
                         const std::function<double(double length)>& metres_per_unit);

}  // namespace svnet::simulation
