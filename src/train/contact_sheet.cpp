#include "train/contact_sheet.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "base/parallel.h"
#include "base/text.h"
#include "image/resize.h"
#include "io/images/image_file.h"

namespace svnet {
namespace {

constexpr Index kPicture = 112, kGap = 4, kLine = 18, kGroupGap = 20;  // pixels
constexpr Index kGroups = 4;                                           // side by side, and objects of a category
constexpr Index kCategories = 12;

void write(cv::Mat& sheet, const std::string& text, Index x, Index y) {
  cv::putText(sheet, text, {static_cast<int>(x), static_cast<int>(y)}, cv::FONT_HERSHEY_SIMPLEX, 0.38, {0, 0, 0}, 1,
              cv::LINE_AA);
}

/// Where the group of a pose begins.
struct Place {
  Index line, column;
};

std::vector<Place> places_of(const ViewDataset& dataset, std::span<const Index> poses) {
  std::vector<Place> places;
  Index category = -1;
  for (const Index pose : poses) {
    const Index here = dataset.poses[static_cast<std::size_t>(pose)].category;
    if (places.empty())
      places.push_back({0, 0});
    else if (here != category || places.back().column + 1 == kGroups)
      places.push_back({places.back().line + 1, 0});
    else
      places.push_back({places.back().line, places.back().column + 1});
    category = here;
  }
  return places;
}

}  // namespace

Image contact_sheet(const ViewDataset& dataset, std::span<const Index> poses, std::span<const Selector> selectors) {
  const std::vector<Place> places = places_of(dataset, poses);
  Index lines = 0, columns = 0;
  for (const Place& place : places)
    lines = std::max(lines, place.line + 1), columns = std::max(columns, place.column + 1);
  const auto count = static_cast<Index>(selectors.size());
  const Index group_width = count * (kPicture + kGap) + kGroupGap, group_height = kPicture + 2 * kLine + kGroupGap;
  Image sheet{lines * group_height + kGroupGap, columns * group_width + kGroupGap, {}};
  sheet.rgb.assign(static_cast<std::size_t>(sheet.height * sheet.width * 3), 255);

  const auto view_of = [&](std::size_t group, Index column) -> const View& {
    return dataset.views[static_cast<std::size_t>(
        selectors[static_cast<std::size_t>(column)].view[static_cast<std::size_t>(poses[group])])];
  };
  const auto corner = [&](std::size_t group, Index column) {
    return std::pair{kGroupGap + places[group].column * group_width + column * (kPicture + kGap),
                     kGroupGap + places[group].line * group_height + kLine};
  };
  Parallel::shared().for_chunks(static_cast<Index>(poses.size()) * count, 1, [&](Index i, Index, int) {
    const auto group = static_cast<std::size_t>(i / count);
    const auto [x, y] = corner(group, i % count);
    const Image picture =
        resized(read_image(dataset.root / view_of(group, i % count).path), kPicture, kPicture, Interpolation::bilinear);
    for (Index row = 0; row < kPicture; ++row)
      std::copy_n(picture.rgb.data() + row * kPicture * 3, kPicture * 3,
                  sheet.rgb.data() + ((y + row) * sheet.width + x) * 3);
  });
  cv::Mat drawn(static_cast<int>(sheet.height), static_cast<int>(sheet.width), CV_8UC3, sheet.rgb.data());
  for (std::size_t group = 0; group < poses.size(); ++group)
    for (Index column = 0; column < count; ++column) {
      const auto [x, y] = corner(group, column);
      if (column == 0) write(drawn, dataset.pose_path(poses[group]), x, y - 5);
      const View& view = view_of(group, column);
      write(drawn, joined(selectors[static_cast<std::size_t>(column)].name, " ", view.phi_deg, ", ", view.theta_deg), x,
            y + kPicture + 12);
    }
  return sheet;
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

}  // namespace svnet
