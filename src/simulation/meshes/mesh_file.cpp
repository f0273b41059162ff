#include "simulation/meshes/mesh_file.h"

#include <fstream>

#include "base/error.h"
#include "base/text.h"
#include "io/files/file_format.h"
#include "io/files/whole_file.h"
#include "mesh_readers.h"

namespace svnet::simulation {
namespace {

namespace fs = std::filesystem;

using Reader = void (*)(std::string_view, const CollectionFiles&, MeshDraft&);

/// By the end of the file's name; null for a name that is not a mesh's.
Reader reader_of(const fs::path& path) {
  const std::string extension = lower_case(path.extension().string());
  if (extension == ".obj") return read_obj;
  if (extension == ".ply") return read_ply;
  if (extension == ".stl") return read_stl;
  if (extension == ".glb" || extension == ".gltf") return read_gltf;
  return nullptr;
}

}  // namespace

bool is_mesh_name(const fs::path& path) { return reader_of(path) != nullptr; }

Mesh read_mesh(const fs::path& path, const MeshReading& reading) {
  const std::string name = path.string();
  check(std::ifstream(path, std::ios::binary).good() && !fs::is_directory(path), name,
        ": cannot be read; expected a mesh (OBJ, PLY, STL or GLB)");
  const Reader read = reader_of(path);
  check(read != nullptr, name, ": is not named like a mesh; expected .obj, .ply, .stl, .glb or .gltf");
  std::string contents = io::whole_file(path);
  const std::string instead = io::recognised_instead(std::string_view(contents));
  try {
    MeshDraft draft(name);
    read(contents, CollectionFiles(path, reading.collection, reading.warn), draft);
    contents = std::string();  // finish needs memory
    return std::move(draft).finish(reading.metres_per_unit);
  } catch (const Error&) {
    check(instead.empty(), name, ": is not a mesh", instead);
    throw;
  }
}

}  // namespace svnet::simulation
