#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/index.h"
#include "simulation/mesh.h"

namespace svnet::simulation {

/// An object to render: a design of the catalogue if `file` is empty, else a mesh file.
struct ObjectSource {
  std::string category, object;  // the names of its folders in the dataset
  Index design = 0;
  std::filesystem::path file;
  std::filesystem::path collection{};  // the folder that the files of the mesh may not leave
};

/// The first `objects` designs of each of `categories`, in their order, or of all categories if none is given. Throws
/// Error for a category that the catalogue does not have or that is given twice.
std::vector<ObjectSource> catalogue_sources(const std::vector<std::string>& categories, Index objects);

/// The files FOLDER/CATEGORY/NAME.obj (or .ply, .stl, .glb, .gltf) and folders FOLDER/CATEGORY/NAME with a mesh in them
/// (meshes/object_folder.h) of `categories`, or of all categories if none is given, in natural order. Each is an object
/// with the name of its file or folder. Names that readers of datasets ignore are left out,
/// and `line` receives one line for each. Throws Error for a category that is missing, empty or given twice, for two
/// meshes of one name, and if there are no meshes.
std::vector<ObjectSource> mesh_sources(const std::filesystem::path& folder, const std::vector<std::string>& categories,
                                       const std::function<void(const std::string&)>& line);

/// The object's mesh in metres; `seed` selects a design beyond the first ones (catalogue_object). Without
/// `metres_per_unit` the size of each mesh decides (meshes/mesh_unit.h). `line` receives what is missing but not
/// needed. Throws Error that begins with the file's name if it cannot be read, or if the object is too large or too
/// small to be rendered.
Mesh mesh_of(const ObjectSource&, std::optional<double> metres_per_unit, std::uint64_t seed,
             const std::function<void(const std::string&)>& line);

}  // namespace svnet::simulation
