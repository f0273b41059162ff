#include "train/view_sheet.h"

#include "base/error.h"
#include "base/parallel.h"
#include "image/contact_sheet.h"
#include "image/resize.h"
#include "io/images/image_file.h"

namespace svnet::train {
namespace {

constexpr Index kGroups = 4;  // in a line, and objects of a category
constexpr Index kCategories = 12;
constexpr SheetLayout kLayout{.cell = 112, .gap = 4, .margin = 20, .text = 18, .font_size = 0.38};

}  // namespace

Image view_sheet(const ViewDataset& dataset, std::span<const Index> poses, std::span<const Selector> selectors) {
  const auto count = static_cast<Index>(selectors.size());
  std::vector<SheetGroup> groups;  // per pose
  for (const Index pose : poses)
    groups.push_back({.cells = std::vector<SheetCell>(selectors.size()), .title = dataset.pose_path(pose)});
  Parallel::shared().for_chunks(static_cast<Index>(poses.size()) * count, 1, [&](Index i, Index, int) {
    const auto group = static_cast<std::size_t>(i / count), column = static_cast<std::size_t>(i % count);
    const Selector& selector = selectors[column];
    const std::int32_t chosen = selector.view[static_cast<std::size_t>(poses[group])];
    const View& view = dataset.views[static_cast<std::size_t>(chosen)];
    groups[group].cells[column] = {resized(io::read_image(dataset.root / view.path, dataset.exif_orientation),
                                           kLayout.cell, kLayout.cell, Interpolation::bilinear),
                                   joined(selector.name, " ", view.phi_deg, ", ", view.theta_deg)};
  });
  std::vector<SheetLine> lines;
  Index category = -1;
  for (std::size_t group = 0; group < poses.size(); ++group) {
    const Index here = dataset.poses[static_cast<std::size_t>(poses[group])].category;
    if (here != category || lines.back().groups.size() == kGroups) lines.emplace_back();
    lines.back().groups.push_back(std::move(groups[group]));
    category = here;
  }
  return contact_sheet(lines, kLayout);
}

std::vector<Index> sheet_poses(const ViewDataset& dataset, const std::vector<bool>& wanted) {
  std::vector<Index> poses, taken(dataset.categories.size(), 0);
  Index categories = 0, last_object = -1;
  for (std::size_t p = 0; p < dataset.poses.size(); ++p) {
    const auto& pose = dataset.poses[p];
    const auto category = static_cast<std::size_t>(pose.category);
    if (!wanted[category] || pose.object == last_object || taken[category] == kGroups) continue;
    if (taken[category] == 0 && ++categories > kCategories) break;
    last_object = pose.object;
    ++taken[category];
    poses.push_back(static_cast<Index>(p));
  }
  return poses;
}

}  // namespace svnet::train
