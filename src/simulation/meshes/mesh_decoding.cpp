#include "mesh_decoding.h"

#include "base/error.h"
#include "base/text.h"
#include "io/files/file_format.h"
#include "mesh_readers.h"

namespace svnet::simulation {
namespace {

namespace fs = std::filesystem;

using Reader = void (*)(std::string_view, const MeshFiles&, MeshDraft&);

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

bool has_mesh_reader(const fs::path& path) { return reader_of(path) != nullptr; }

Mesh decode_mesh(std::string_view contents, const MeshFiles& files,
                 const std::function<double(double length)>& metres_per_unit) {
  const std::string instead = io::recognised_instead(contents);
  try {
    MeshDraft draft(files.name());
    reader_of(files.name())(contents, files, draft);
    return std::move(draft).finish(metres_per_unit);
  } catch (const Error&) {
    check(instead.empty(), files.name(), ": is not a mesh", instead);
    throw;
  }
}

}  // namespace svnet::simulation
