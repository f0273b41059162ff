#include "simulation/meshes/mesh_file.h"

#include <cerrno>
#include <fstream>
#include <new>

#include "base/error.h"
#include "collection_files.h"
#include "io/files/whole_file.h"
#include "mesh_decoding.h"
#include "remote_mesh.h"
#include "sandbox/mode.h"

namespace svnet::simulation {

namespace fs = std::filesystem;

bool is_mesh_name(const fs::path& path) { return has_mesh_reader(path); }

Mesh read_mesh(const fs::path& path, const MeshReading& reading) {
  const std::string name = path.string();
  errno = 0;
  const bool is_readable = std::ifstream(path, std::ios::binary).good();
  if (!is_readable && errno == ENOMEM) throw std::bad_alloc();
  check(is_readable && !fs::is_directory(path), name, ": cannot be read; expected a mesh (OBJ, PLY, STL or GLB)");
  check(has_mesh_reader(path), name, ": is not named like a mesh; expected .obj, .ply, .stl, .glb or .gltf");
  const CollectionFiles files(path, reading.collection, reading.warn);
  if (sandbox::mode() == sandbox::Mode::on) return read_mesh_elsewhere(path, files, reading.metres_per_unit);
  return decode_mesh(io::whole_file(path), files, reading.metres_per_unit);
}

}  // namespace svnet::simulation
