#include "sort/objects.h"

#include <algorithm>

#include "base/error.h"
#include "base/text.h"
#include "io/images/image_name.h"
#include "io/views/dataset_folder.h"

namespace svnet {
namespace fs = std::filesystem;

namespace {

bool is_folder(const fs::path& path) {
  std::error_code unreadable;
  return fs::is_directory(path, unreadable);
}

/// The pictures and folders in a folder, in natural order.
std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> found;
  try {
    for (const auto& entry : fs::directory_iterator(folder)) {
      const fs::path name = entry.path().filename();
      if (!io::is_ignored_name(name) && (is_folder(entry.path()) || io::is_image_name(name)))
        found.push_back(entry.path());
    }
  } catch (const fs::filesystem_error& error) {
    fail(folder.string(), ": cannot be read: ", error.code().message());
  }
  std::ranges::sort(found, [](const fs::path& a, const fs::path& b) { return natural_less(a.string(), b.string()); });
  return found;
}

/// The pictures in a folder at any depth.
std::vector<fs::path> pictures_in(const fs::path& folder) {
  constexpr std::size_t kDeepest = 32;  // a circle of symbolic links ends here
  struct Level {
    fs::path path;
    std::size_t depth;
  };
  std::vector<fs::path> pictures;
  std::vector<Level> left{{folder, 0}};  // the next one last
  while (!left.empty()) {
    const Level level = left.back();
    left.pop_back();
    if (!is_folder(level.path)) {
      pictures.push_back(level.path);
      continue;
    }
    check(level.depth < kDeepest, level.path.string(), ": is more than ", kDeepest, " folders deep");
    std::vector<fs::path> entries = entries_of(level.path);
    for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry)
      left.push_back({std::move(*entry), level.depth + 1});
  }
  return pictures;
}

}  // namespace

std::vector<SortedObject> sorted_objects(const std::vector<fs::path>& arguments) {
  std::vector<SortedObject> objects;
  if (arguments.size() == 1 && is_folder(arguments[0])) {
    for (const fs::path& entry : entries_of(arguments[0])) {
      SortedObject object{entry.filename().string(), pictures_in(entry)};
      if (!object.pictures.empty()) objects.push_back(std::move(object));
    }
    check(!objects.empty(), arguments[0].string(),
          ": holds no PNG, JPEG or WebP file, and no folder with such files; each picture and each folder of pictures "
          "is an object");
    return objects;
  }
  for (const fs::path& argument : arguments) {
    SortedObject object{argument.string(), pictures_in(argument)};
    check(!object.pictures.empty(), argument.string(), ": holds no PNG, JPEG or WebP file");
    objects.push_back(std::move(object));
  }
  return objects;
}

}  // namespace svnet
