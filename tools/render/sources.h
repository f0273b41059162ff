#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/index.h"
#include "simulation/mesh.h"

namespace svnet {

/// One object to collect: a design of the catalogue, or a mesh file.
struct Source {
  std::string category, object;
  Index design = 0;
  std::filesystem::path file, collection;  // the folder that its textures may not leave
};

/// The first designs of each category, in the order of `categories`, or of all. Throws Error for a category that the
/// catalogue does not have, or that is named twice.
std::vector<Source> catalogue_sources(const std::vector<std::string>& categories, Index objects);

/// FOLDER/CATEGORY/NAME.obj (or .ply, .stl, .glb, .gltf), or FOLDER/CATEGORY/NAME/ with a mesh in it, of `categories`,
/// or of all: each mesh is an object named like its file or folder, in natural order. Names that readers of data sets
/// ignore are left out, in a line to `say`. Throws Error for a category that is missing, empty or named twice, for two
/// meshes of one name, and where there are none.
std::vector<Source> mesh_sources(const std::filesystem::path& folder, const std::vector<std::string>& categories,
                                 const std::function<void(const std::string& line)>& say);

/// The object's mesh. `metres_per_unit`: none lets each file's size tell (simulation/meshes/mesh_unit.h). What is
/// missing but not needed is a line to `say`. Throws Error that begins with the file's name, also where the object is
/// too large or too small to be collected, as in a wrong unit.
Mesh mesh_of(const Source&, std::optional<double> metres_per_unit, std::uint64_t seed,
             const std::function<void(const std::string& line)>& say);

}  // namespace svnet
