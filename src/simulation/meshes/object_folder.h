#pragma once
#include <filesystem>
#include <functional>
#include <string>

namespace svnet::simulation {

/// The mesh of an object that has a folder of its own, up to three levels deep: FOLDER/textured.obj,
/// FOLDER/google_16k/textured.obj, FOLDER/meshes/model.obj. Of several the formats with textures come first (OBJ, GLB,
/// glTF, then PLY, then STL), then the ones nearest to the folder, then those that are not meant for collisions, then
/// the first in natural order, in a line to `say`. Empty if there is none; names that begin with '_' or '.' are
/// ignored.
std::filesystem::path mesh_of_folder(const std::filesystem::path& folder,
                                     const std::function<void(const std::string& line)>& say);

}  // namespace svnet::simulation
