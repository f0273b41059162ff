#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace svnet::simulation {

/// The files that a mesh names, as its reader sees them, and where its warnings go.
class MeshFiles {
 public:
  explicit MeshFiles(std::string name) : name_(std::move(name)) {}
  virtual ~MeshFiles() = default;

  /// None if there is no such file. `kind`, such as "texture", is for messages. Throws Error if the path leaves
  /// the collection. An absolute path, which was true on another machine, is looked up beside the mesh, with a warning.
  virtual std::optional<std::filesystem::path> find(const char* kind, const std::string& reference) const = 0;
  /// Of a file that was found; once. Throws Error if it cannot be read.
  virtual std::string contents(const std::filesystem::path& found) const = 0;
  /// One line that begins with the mesh's name.
  virtual void warn(const std::string& text) const = 0;
  /// Of the mesh, in messages.
  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

}  // namespace svnet::simulation
