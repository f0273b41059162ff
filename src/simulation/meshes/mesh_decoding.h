#pragma once
#include <filesystem>
#include <functional>
#include <string_view>

#include "mesh_files.h"
#include "simulation/mesh.h"

namespace svnet::simulation {

/// Whether a file's name is that of a mesh; mesh_file.h.
bool has_mesh_reader(const std::filesystem::path& path);

/// The mesh in the whole file `contents`, of the kind that `files.name()` says. Throws Error that begins with that
/// name.
Mesh decode_mesh(std::string_view contents, const MeshFiles& files,
                 const std::function<double(double length)>& metres_per_unit);

}  // namespace svnet::simulation
