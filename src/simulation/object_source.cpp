#include "simulation/object_source.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <map>

#include "base/error.h"
#include "base/text.h"
#include "io/views/dataset_folder.h"
#include "simulation/catalogue.h"
#include "simulation/collection.h"
#include "simulation/meshes/mesh_file.h"

namespace svnet {
namespace {

namespace fs = std::filesystem;

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Throws Error for names that are not in `known` or given twice. `where` follows the name in messages.
void check_categories(const std::vector<std::string>& categories, const std::vector<std::string>& known,
                      const std::string& where) {
  for (auto name = categories.begin(); name != categories.end(); ++name) {
    check(contains(known, *name), "there is no category '", *name, "'", where, suggestion(*name, known));
    check(std::find(categories.begin(), name, *name) == name, "the category '", *name, "' is given twice");
  }
}

std::vector<fs::path> sorted_entries(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> entries;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    entries.push_back(entry->path());
  check(!error, folder.string(), ": cannot be read: ", error.message());
  std::sort(entries.begin(), entries.end(), [](const fs::path& a, const fs::path& b) {
    return natural_less(a.filename().string(), b.filename().string());
  });
  return entries;
}

/// The entries for which `is_wanted_kind` holds, without those whose names readers of datasets ignore.
std::vector<fs::path> named_entries(const fs::path& folder, bool (*is_wanted_kind)(const fs::path&),
                                    const std::function<void(const std::string&)>& line) {
  std::vector<fs::path> entries;
  for (const fs::path& entry : sorted_entries(folder)) {
    if (!is_wanted_kind(entry)) continue;
    if (is_ignored_name(entry.filename()))
      line("left out: " + entry.string() + ": names that begin with '_' or '.' are ignored in data sets");
    else
      entries.push_back(entry);
  }
  return entries;
}

std::vector<ObjectSource> sources_of_category(const fs::path& folder,
                                              const std::function<void(const std::string&)>& line) {
  const std::string category = folder.filename().string();
  std::vector<ObjectSource> sources;
  std::map<std::string, fs::path> named;
  for (const fs::path& file : named_entries(folder, is_mesh_name, line)) {
    const std::string object = file.stem().string();
    const auto [twin, is_first] = named.emplace(object, file);
    check(is_first, twin->second.string(), " and ", file.string(), ": both are the object '", object,
          "'; rename one of them");
    sources.push_back({category, object, 0, file});
  }
  return sources;
}

std::string length_text(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, metres < 0.01 ? "%.3g mm" : "%.3g m", metres < 0.01 ? metres * 1000 : metres);
  return text;
}

/// A sentence that suggests metres, millimetres or centimetres if an object `units` long then has a household size.
std::string unit_hint(double units) {
  for (const double unit : {1.0, 0.001, 0.01})
    if (units * unit >= 0.03 && units * unit <= 0.5)
      return joined(" With --unit ", unit, " it would be ", length_text(units * unit), ".");
  return "";
}

void check_size(const Mesh& mesh, const std::string& name, double metres_per_unit) {
  Eigen::AlignedBox3f box;
  for (const Vec3& point : mesh.points) box.extend(point);
  const double length_m = box.sizes().cast<double>().maxCoeff();
  check(length_m >= kSmallestObject_m && length_m <= kLargestObject_m, name, ": is ", length_text(length_m),
        " long, objects may be ", length_text(kSmallestObject_m), " to ", length_text(kLargestObject_m),
        "; is its unit right?", unit_hint(length_m / metres_per_unit));
}

}  // namespace

std::vector<ObjectSource> catalogue_sources(const std::vector<std::string>& categories, Index objects) {
  check_categories(categories, catalogue_names(), "");
  std::vector<ObjectSource> sources;
  for (const std::string& name : categories.empty() ? catalogue_names() : categories)
    for (Index object = 0; object < objects; ++object)
      sources.push_back({name, std::to_string(object + 1), object, {}});
  return sources;
}

std::vector<ObjectSource> mesh_sources(const fs::path& folder, const std::vector<std::string>& categories,
                                       const std::function<void(const std::string&)>& line) {
  constexpr const char* kExpected = "; expected CATEGORY/NAME.obj, .ply, .stl or .glb in it";
  const auto folders = named_entries(
      folder, [](const fs::path& entry) { return fs::is_directory(entry); }, line);
  std::vector<std::string> names;
  names.reserve(folders.size());
  for (const fs::path& category : folders) names.push_back(category.filename().string());
  check(!names.empty(), folder.string(), ": holds no meshes", kExpected);
  check_categories(categories, names, " in " + folder.string());
  std::vector<ObjectSource> sources;
  for (const fs::path& category : folders) {
    const bool is_wanted = contains(categories, category.filename().string());
    if (!categories.empty() && !is_wanted) continue;
    const auto found = sources_of_category(category, line);
    check(!is_wanted || !found.empty(), category.string(), ": holds no meshes; expected NAME.obj, .ply, .stl or .glb");
    sources.insert(sources.end(), found.begin(), found.end());
  }
  check(!sources.empty(), folder.string(), ": holds no meshes", kExpected);
  return sources;
}

Mesh mesh_of(const ObjectSource& source, double metres_per_unit, std::uint64_t seed) {
  if (source.file.empty()) return catalogue_object(source.category, source.design, seed);
  Mesh mesh = read_mesh(source.file, metres_per_unit);
  check_size(mesh, source.file.string(), metres_per_unit);
  return mesh;
}

}  // namespace svnet
