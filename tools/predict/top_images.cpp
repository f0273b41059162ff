#include "predict/top_images.h"

#include <algorithm>

#include "base/error.h"
#include "base/text.h"
#include "io/images/image_name.h"
#include "io/views/dataset_folder.h"

namespace svnet {
namespace fs = std::filesystem;

namespace {

std::vector<TopImage> of_dataset(const fs::path& folder) {
  const ViewDataset dataset = io::read_view_dataset(folder);
  std::vector<TopImage> images;
  for (std::size_t i = 0; i < dataset.poses.size(); ++i) {
    const auto pose = static_cast<Index>(i);
    const View& top = dataset.views[static_cast<std::size_t>(dataset.top_view(pose))];
    TopImage image{.name = top.path, .image = folder / top.path};
    image.depth = io::find_top_depth(dataset, pose).value_or(fs::path());
    for (const View& view : dataset.views_of(pose)) {
      image.poses.push_back({static_cast<double>(view.theta_deg), static_cast<double>(view.phi_deg)});
      image.views.push_back(folder / view.path);
    }
    images.push_back(std::move(image));
  }
  return images;
}

fs::path depth_of(const fs::path& image, const fs::path& folder) {
  if (folder.empty()) return {};
  for (const char* ending : {".png", ".npy"}) {
    const fs::path file = folder / (image.stem().string() + ending);
    if (fs::exists(file)) return file;
  }
  fail((folder / (image.stem().string() + ".png")).string(), ": no such file, nor one ending in .npy; ",
       image.filename().string(), " needs its depth image there");
}

}  // namespace

std::vector<TopImage> top_images(const fs::path& folder, const fs::path& depth) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (io::is_ignored_name(entry.path().filename())) continue;
    if (entry.is_directory()) {
      check(depth.empty(), depth.string(),
            ": --depth is not needed with a data set, which has its depth images in _extra");
      return of_dataset(folder);
    }
    if (io::is_image_name(entry.path())) files.push_back(entry.path());
  }
  check(!files.empty(), folder.string(), ": holds no PNG, JPEG or WebP file, and no data set");
  std::ranges::sort(files, [](const fs::path& a, const fs::path& b) { return natural_less(a.string(), b.string()); });
  std::vector<TopImage> images;
  for (const fs::path& file : files)
    images.push_back({.name = file.filename().string(), .image = file, .depth = depth_of(file, depth)});
  return images;
}

}  // namespace svnet
