#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "simulation/mesh.h"

namespace svnet::simulation {

/// Whether a file's name ends like that of a mesh: .obj, .ply, .stl, .glb or .gltf, in small or capital letters.
bool is_mesh_name(const std::filesystem::path& path);

struct MeshReading {
  /// Textures and materials may lie anywhere in it, and nowhere else. Empty: the mesh's own folder.
  std::filesystem::path collection{};
  /// Of an object of this length in the file's units. May throw.
  std::function<double(double length)> metres_per_unit = [](double) { return 1.0; };
  /// Takes what is missing but not needed, a line each that begins with the file's name.
  std::function<void(const std::string& line)> warn = [](const std::string&) {};
};

/// A mesh with its colours and textures (OBJ, PLY, STL, GLB or glTF) in metres, with normals; one that lies far from
/// its origin is centred. Throws Error, one line that names the file, if it cannot be read, is cut off, requires an
/// extension that is not read, holds no triangles or numbers that are not finite, is larger than 5 million triangles,
/// or names a texture that cannot be decoded or lies outside the collection. A texture or material file that is missing
/// is a warning.
Mesh read_mesh(const std::filesystem::path& path, const MeshReading& reading = {});

}  // namespace svnet::simulation
