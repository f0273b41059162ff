#include "collection_files.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "io/files/whole_file.h"

namespace svnet::simulation {
namespace {

namespace fs = std::filesystem;

fs::path normal(const fs::path& path) {
  const fs::path result = fs::absolute(path).lexically_normal();
  return result.has_filename() ? result : result.parent_path();
}

bool lies_in(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored) && !fs::is_directory(path, ignored);
}

/// Of this machine or of another, whose drives have letters.
bool is_absolute(const std::string& path) {
  return path.starts_with('/') || (path.size() > 2 && path[1] == ':' && path[2] == '/');
}

}  // namespace

CollectionFiles::CollectionFiles(const fs::path& mesh, const fs::path& collection, Say warn)
    : MeshFiles(mesh.string()), warn_(std::move(warn)) {
  const fs::path folder = normal(mesh).parent_path();
  fs::path root = collection.empty() ? folder : normal(collection);
  if (!lies_in(folder, root)) root = folder;
  places_.push_back({folder, root});
  std::error_code error;
  const fs::path target = fs::canonical(mesh, error).parent_path();
  if (error || target == fs::canonical(folder, error)) return;
  fs::path target_root = target;
  for (auto depth = std::distance(folder.begin(), folder.end()) - std::distance(root.begin(), root.end());
       depth > 0 && target_root.parent_path().has_relative_path(); --depth)
    target_root = target_root.parent_path();
  places_.push_back({target, target_root});
}

std::optional<fs::path> CollectionFiles::find(const char* kind, const std::string& reference) const {
  std::string written = reference;
  std::replace(written.begin(), written.end(), '\\', '/');
  if (written.starts_with("file://")) written.erase(0, 7);
  bool leaves = true;
  for (const Place& place : places_) {
    fs::path path = (is_absolute(written) ? fs::path(written) : place.folder / written).lexically_normal();
    if (!lies_in(path, place.collection)) continue;
    leaves = false;
    if (is_file(path)) return path;
  }
  const fs::path file = fs::path(written).filename();
  if (is_absolute(written) && leaves)
    for (const Place& place : places_)
      if (is_file(place.folder / file)) {
        warn(joined(kind, " '", printable(reference), "' is taken from beside the mesh"));
        return place.folder / file;
      }
  check(!leaves, name(), ": ", kind, " '", printable(reference), "' lies outside the collection ",
        places_.front().collection.string(), "; copy it there and name it by a relative path");
  for (const Place& place : places_)
    if (fs::path path = (place.folder / "../materials/textures" / file).lexically_normal();
        !is_absolute(written) && lies_in(path, place.collection) && is_file(path))
      return path;
  return std::nullopt;
}

std::string CollectionFiles::contents(const fs::path& found) const { return io::whole_file(found); }

}  // namespace svnet::simulation
