#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mesh_files.h"

namespace svnet::simulation {

/// Finds the files that a mesh names: as they are written, with / or \, relative to the mesh file, or to the target of
/// a symbolic link to it. They may lie anywhere in the collection, which of a link's target is as many folders above
/// it. Last, textures are looked for in ../materials/textures, as Gazebo does.
class CollectionFiles : public MeshFiles {
 public:
  using Say = std::function<void(const std::string& line)>;

  /// `collection` empty: the mesh's own folder.
  CollectionFiles(const std::filesystem::path& mesh, const std::filesystem::path& collection, Say warn);

  std::optional<std::filesystem::path> find(const char* kind, const std::string& reference) const override;
  std::string contents(const std::filesystem::path& found) const override;
  void warn(const std::string& text) const override { warn_(name() + ": " + text); }

 private:
  struct Place {
    std::filesystem::path folder, collection;
  };
  std::vector<Place> places_;
  Say warn_;
};

}  // namespace svnet::simulation
