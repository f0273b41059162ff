#include "data/view_dataset.h"

#include <iterator>
#include <utility>

#include "base/error.h"
#include "base/text.h"

namespace svnet {

std::span<const View> ViewDataset::views_of(Index pose) const {
  const Pose& range = poses[static_cast<std::size_t>(pose)];
  return std::span(views).subspan(static_cast<std::size_t>(range.first_view),
                                  static_cast<std::size_t>(range.view_count));
}

std::vector<std::int32_t> ViewDataset::pose_of_view() const {
  std::vector<std::int32_t> poses_of_views;
  for (const View& view : views) poses_of_views.push_back(static_cast<std::int32_t>(view.pose));
  return poses_of_views;
}

std::string ViewDataset::pose_path(Index pose) const {
  const Pose& p = poses[static_cast<std::size_t>(pose)];
  return joined(categories[static_cast<std::size_t>(p.category)], '/', objects[static_cast<std::size_t>(p.object)].name,
                '/', p.name);
}

ViewDataset with_categories(const ViewDataset& dataset, const std::vector<bool>& wanted) {
  ViewDataset part;
  part.root = dataset.root;
  part.exif_orientation = dataset.exif_orientation;
  part.ignored = dataset.ignored;
  Index last_category = -1, last_object = -1;
  for (const ViewDataset::Pose& pose : dataset.poses) {
    if (!wanted[static_cast<std::size_t>(pose.category)]) continue;
    if (pose.category != last_category)
      part.categories.push_back(dataset.categories[static_cast<std::size_t>(pose.category)]);
    last_category = pose.category;
    const Index category = std::ssize(part.categories) - 1;
    if (pose.object != last_object)
      part.objects.push_back({dataset.objects[static_cast<std::size_t>(pose.object)].name, category});
    last_object = pose.object;
    const Index object = std::ssize(part.objects) - 1, first_view = std::ssize(part.views);
    for (Index v = pose.first_view; v < pose.first_view + pose.view_count; ++v) {
      View view = dataset.views[static_cast<std::size_t>(v)];
      view.category = category;
      view.object = object;
      view.pose = std::ssize(part.poses);
      part.views.push_back(std::move(view));
    }
    ViewDataset::Pose moved = pose;
    moved.category = category;
    moved.object = object;
    moved.first_view = first_view;
    moved.top_view = first_view + pose.top_view - pose.first_view;
    part.poses.push_back(std::move(moved));
  }
  return part;
}

}  // namespace svnet
