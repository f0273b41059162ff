#pragma once
#include <map>
#include <optional>
#include <string>

#include "io/images/image_codecs.h"
#include "mesh_draft.h"
#include "mesh_files.h"

namespace svnet::simulation {

/// The textures of one mesh, each read once. A texture that is missing gives none, with one warning; one that cannot be
/// decoded, or lies outside the collection, throws Error.
class MeshTextures {
 public:
  MeshTextures(const MeshFiles& files, MeshDraft& draft) : files_(files), draft_(draft) {}

  /// The index of the image in a file, by the path that the mesh gives.
  std::optional<int> file(const std::string& reference);
  /// Of one that is inside the mesh file under the name `reference`.
  int embedded(const std::string& reference, io::Bytes contents);

 private:
  const MeshFiles& files_;
  MeshDraft& draft_;
  std::map<std::string, std::optional<int>> by_reference_, by_path_;
};

}  // namespace svnet::simulation
