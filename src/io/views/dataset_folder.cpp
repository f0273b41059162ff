#include "io/views/dataset_folder.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <numeric>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/error.h"
#include "base/sha256.h"
#include "base/text.h"
#include "io/files/file_hash.h"
#include "io/images/image_name.h"
#include "io/views/composed_name.h"

namespace svnet::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* kViewNames = "PHI_THETA.png, .jpg, .jpeg or .webp, such as 45_90.png";

/// Files and folders that systems leave beside images, in lower case.
constexpr std::array<std::string_view, 9> kLeftBySystems{".ds_store",    "@eadir",      "thumbs.db",
                                                         "ehthumbs.db",  "desktop.ini", "lost+found",
                                                         "$recycle.bin", "icon\r",      "system volume information"};

bool is_left_by_system(const fs::path& name) {
  const std::string lower = lower_case(name.native());
  return std::find(kLeftBySystems.begin(), kLeftBySystems.end(), lower) != kLeftBySystems.end() ||
         lower.starts_with("._");
}

/// The entries of a folder that are not ignored, in natural order of their names. Appends what systems left to
/// `dataset.ignored`.
std::vector<fs::path> entries(const fs::path& folder, ViewDataset& dataset) {
  std::vector<fs::path> found;
  std::vector<std::string> ignored;
  try {
    for (const auto& entry : fs::directory_iterator(folder)) {
      const fs::path& path = entry.path();
      if (is_left_by_system(path.filename()))
        ignored.push_back(path.lexically_relative(dataset.root).generic_string());
      else if (!is_ignored_name(path.filename()))
        found.push_back(path);
    }
  } catch (const fs::filesystem_error& error) {
    fail(folder.string(), ": cannot be read: ", error.code().message());
  }
  for (const fs::path& path : found)
    check(is_plain_utf8(path.filename().native()), printable(path.string()), ": its name is not UTF-8; rename it");
  std::sort(found.begin(), found.end(), [](const fs::path& a, const fs::path& b) {
    return natural_less(composed_name(a.filename().native()), composed_name(b.filename().native()));
  });
  std::sort(ignored.begin(), ignored.end());
  dataset.ignored.insert(dataset.ignored.end(), ignored.begin(), ignored.end());
  return found;
}

bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// The subfolders of `folder`. `what` it is and the `part` that each of them is are words for messages.
std::vector<fs::path> subfolders(const fs::path& folder, const char* what, const char* part, ViewDataset& dataset) {
  std::vector<fs::path> found = entries(folder, dataset);
  for (const fs::path& path : found)
    check(is_folder(path), path.string(), ": stray file; ", what, " holds folders only, ", part,
          " each (names that begin with '_' or '.' are ignored)");
  check(!found.empty(), folder.string(), ": ", what, " without folders; expected ", part,
        " in each (category/object/pose/", kViewNames, ")");
  return found;
}

/// One to four digits as a number.
std::optional<int> angle(std::string_view text) {
  if (text.empty() || text.size() > 4 ||
      !std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; }))
    return std::nullopt;
  int value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

struct Angles {
  int phi_deg, theta_deg;
};

Angles angles_of(const fs::path& path) {
  check(is_file(path) && is_image_name(path), path.string(), ": not a view; a pose holds files named ", kViewNames,
        " (names that begin with '_' or '.' are ignored)");
  const std::string stem = path.stem().string();
  const std::size_t line = stem.find('_');
  const auto phi = line == std::string::npos ? std::nullopt : angle(std::string_view(stem).substr(0, line));
  const auto theta = line == std::string::npos ? std::nullopt : angle(std::string_view(stem).substr(line + 1));
  check(phi && theta, path.string(), ": the name of a view must be ", kViewNames,
        ": two whole numbers of degrees with '_' between them");
  check(*phi <= 90, path.string(), ": phi is ", *phi, ", expected 0 to 90 degrees (PHI_THETA)");
  check(*theta <= 359, path.string(), ": theta is ", *theta, ", expected 0 to 359 degrees (PHI_THETA)");
  return {*phi, *theta};
}

void read_pose(const fs::path& folder, Index object, ViewDataset& dataset) {
  const std::vector<fs::path> files = entries(folder, dataset);
  check(!files.empty(), folder.string(), ": pose without views; expected ", kViewNames);
  const auto number = static_cast<Index>(dataset.poses.size());
  const Index category = dataset.objects[static_cast<std::size_t>(object)].category;
  ViewDataset::Pose pose{folder.filename().string(),       object, category, static_cast<Index>(dataset.views.size()),
                         static_cast<Index>(files.size()), -1};
  std::map<std::pair<int, int>, fs::path> seen;
  for (const fs::path& file : files) {
    const auto [phi_deg, theta_deg] = angles_of(file);
    const auto [first, is_new] = seen.emplace(std::pair(phi_deg, theta_deg), file);
    check(is_new, file.string(), ": the same view as ", first->second.filename().string(), "; remove one of them");
    const bool top = phi_deg == 90 && theta_deg == 90;
    if (top) pose.top_view = static_cast<Index>(dataset.views.size());
    dataset.views.push_back(
        {file.lexically_relative(dataset.root).generic_string(), category, object, number, phi_deg, theta_deg, top});
  }
  check(pose.top_view >= 0, folder.string(), ": pose without its top view; expected 90_90.png, .jpg, .jpeg or .webp");
  dataset.poses.push_back(std::move(pose));
}

}  // namespace

bool is_ignored_name(const fs::path& name) {
  return name.native().front() == '_' || name.native().front() == '.' || is_left_by_system(name);
}

ViewDataset read_view_dataset(const fs::path& root, ExifOrientation exif_orientation) {
  std::error_code error;
  const fs::file_status status = fs::status(root, error);
  check(status.type() != fs::file_type::not_found, root.string(), ": no such folder; expected a data set (folders ",
        "category/object/pose with views ", kViewNames, ")");
  check(!error, root.string(), ": cannot be read: ", error.message());
  check(fs::is_directory(status), root.string(), ": is not a folder; expected a data set (folders ",
        "category/object/pose with views ", kViewNames, ")");

  ViewDataset dataset;
  dataset.root = root;
  dataset.exif_orientation = exif_orientation;
  for (const fs::path& category : entries(root, dataset)) {
    const std::string name = composed_name(category.filename().string());
    if (is_file(category)) {
      if (name != "manifest.json") dataset.ignored.push_back(category.filename().string());
      continue;
    }
    check(is_folder(category), category.string(), ": neither a file nor a folder; expected a category's folder");
    for (const fs::path& object : subfolders(category, "a category", "an object", dataset)) {
      dataset.objects.push_back({object.filename().string(), static_cast<Index>(dataset.categories.size())});
      for (const fs::path& pose : subfolders(object, "an object", "a pose", dataset))
        read_pose(pose, static_cast<Index>(dataset.objects.size()) - 1, dataset);
    }
    check(dataset.categories.empty() || dataset.categories.back() != name, category.string(),
          ": the same category as another folder, whose name has its accents in another Unicode form; rename one");
    dataset.categories.push_back(name);
  }
  check(!dataset.categories.empty(), root.string(), ": data set without categories; expected folders ",
        "category/object/pose with views ", kViewNames);
  return dataset;
}

std::optional<fs::path> find_top_depth(const ViewDataset& dataset, Index pose) {
  const fs::path image = dataset.views[static_cast<std::size_t>(dataset.top_view(pose))].path;
  for (const char* ending : {"_depth.png", "_depth.npy"}) {
    const fs::path file = dataset.root / "_extra" / image.parent_path() / (image.stem().string() + ending);
    if (fs::exists(file)) return file;
  }
  return {};
}

std::string fingerprint(const ViewDataset& dataset, Parallel& parallel) {
  std::vector<std::size_t> order(dataset.views.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return composed_name(dataset.views[a].path) < composed_name(dataset.views[b].path);
  });
  std::vector<std::string> hashes(order.size());
  parallel.for_chunks(static_cast<Index>(order.size()), 16, [&](Index begin, Index end, int) {
    for (Index i = begin; i < end; ++i)
      hashes[static_cast<std::size_t>(i)] =
          file_sha256(dataset.root / dataset.views[order[static_cast<std::size_t>(i)]].path);
  });
  Sha256 all;
  for (std::size_t i = 0; i < order.size(); ++i)
    all.update_field(composed_name(dataset.views[order[i]].path)).update_field(hashes[i]);
  switch (dataset.exif_orientation) {
    case ExifOrientation::ignore:
      break;
    case ExifOrientation::obey:
      all.update_field("exif orientation obeyed");
      break;
  }
  return all.hex();
}

}  // namespace svnet::io
