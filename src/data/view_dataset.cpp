#include "data/view_dataset.h"

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

}  // namespace svnet
