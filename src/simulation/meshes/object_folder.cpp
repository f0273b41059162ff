#include "object_folder.h"

#include <algorithm>
#include <array>
#include <vector>

#include "base/error.h"
#include "base/text.h"
#include "mesh_file.h"

namespace svnet::simulation {
namespace {

namespace fs = std::filesystem;

struct Candidate {
  std::array<int, 3> rank;  // lower is better
  fs::path file;
};

int format_rank(const fs::path& file) {
  const std::string extension = lower_case(file.extension().string());
  return extension == ".stl" ? 2 : extension == ".ply" ? 1 : 0;
}

/// Whether the name is that of a stand-in for the object.
bool is_stand_in(const fs::path& file) {
  const std::string name = lower_case(file.stem().string());
  for (const char* word : {"collision", "convex", "vhacd", "nontextured"})
    if (name.find(word) != std::string::npos) return true;
  return false;
}

void add_candidates(const fs::path& folder, int depth, std::vector<Candidate>& found) {
  constexpr int kDeepest = 3;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const fs::path& path = entry->path();
    const std::string name = path.filename().string();
    if (name.starts_with('.') || name.starts_with('_')) continue;
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) {
      if (depth < kDeepest) add_candidates(path, depth + 1, found);
    } else if (is_mesh_name(path)) {
      found.push_back({{format_rank(path), depth, is_stand_in(path) ? 1 : 0}, path});
    }
  }
  check(!error, folder.string(), ": cannot be read: ", error.message());
}

}  // namespace

fs::path mesh_of_folder(const fs::path& folder, const std::function<void(const std::string&)>& say) {
  std::vector<Candidate> found;
  add_candidates(folder, 0, found);
  if (found.empty()) return {};
  std::sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    if (a.rank != b.rank) return a.rank < b.rank;
    return natural_less(a.file.string(), b.file.string());
  });
  const auto alike = std::count_if(found.begin(), found.end(),
                                   [&](const Candidate& candidate) { return candidate.rank == found[0].rank; });
  if (alike > 1) say(joined(folder.string(), ": holds ", alike, " such meshes; ", found[0].file.string(), " is taken"));
  return found[0].file;
}

}  // namespace svnet::simulation
