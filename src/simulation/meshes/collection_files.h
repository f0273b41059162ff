#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace svnet::simulation {

/// Finds the files that a mesh names: as they are written, with / or \, relative to the mesh file, or to the target of
/// a symbolic link to it. They may lie anywhere in the collection, which of a link's target is as many folders above
/// it. Last, textures are looked for in ../materials/textures, as Gazebo does.
class CollectionFiles {
 public:
  using Say = std::function<void(const std::string& line)>;

  /// `collection` empty: the mesh's own folder.
  CollectionFiles(const std::filesystem::path& mesh, const std::filesystem::path& collection, Say warn);

  /// None if there is no such file. `kind`, such as "texture", is for messages. Throws Error if the path leaves
  /// the collection. An absolute path, which was true on another machine, is looked up beside the mesh, with a warning.
  std::optional<std::filesystem::path> find(const char* kind, const std::string& reference) const;

  /// One line that begins with the mesh's name.
  void warn(const std::string& text) const { warn_(name_ + ": " + text); }
  const std::string& name() const { return name_; }

 private:
  struct Place {
    std::filesystem::path folder, collection;
  };
  std::string name_;
  std::vector<Place> places_;
  Say warn_;
};

}  // namespace svnet::simulation
