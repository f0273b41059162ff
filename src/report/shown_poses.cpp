#include "report/shown_poses.h"

#include <algorithm>
#include <cmath>

#include "image/contact_sheet.h"
#include "io/images/depth_file.h"
#include "io/images/image_file.h"
#include "train/top_frames.h"

namespace svnet::report {
namespace {

constexpr std::size_t kFigures = 12;
constexpr Index kFigureSide_px = 160, kRowSide_px = 88;
constexpr int kJpegQuality = 78;
constexpr std::size_t kMostPictureBytes = 2'800'000;  // in base64 they take a third more

ShownPose shown_pose(const ViewDataset& dataset, const ViewDataset::Pose& pose,
                     const std::vector<ViewPrediction>& predictions) {
  ShownPose shown{.category = dataset.categories[static_cast<std::size_t>(pose.category)],
                  .object = dataset.objects[static_cast<std::size_t>(pose.object)].name,
                  .pose = pose.name,
                  .views = {},
                  .top = static_cast<std::size_t>(pose.top_view - pose.first_view)};
  shown.chosen = shown.top;
  double sum = 0, count = 0, highest = -1e300;
  for (Index v = pose.first_view; v < pose.first_view + pose.view_count; ++v) {
    const View& view = dataset.views[static_cast<std::size_t>(v)];
    const ViewPrediction& known = predictions[static_cast<std::size_t>(v)];
    const std::size_t place = shown.views.size();
    shown.views.push_back({view.theta_deg, view.phi_deg, known.predicted, known.score, known.standard_error});
    if (known.predicted > highest) {  // false for NaN; the first among equals, as the selector svnet chooses
      highest = known.predicted;
      shown.chosen = place;
    }
    if (!std::isfinite(known.score)) continue;
    sum += known.score;
    ++count;
    if (!shown.best || known.score > shown.views[*shown.best].score) shown.best = place;
    if (!shown.worst || known.score < shown.views[*shown.worst].score) shown.worst = place;
  }
  shown.mean_score = sum / count;
  return shown;
}

std::array<Picture, 3> pictures_of(const ViewDataset& dataset, Index pose, const ShownPose& shown, Index side) {
  const Index first = dataset.poses[static_cast<std::size_t>(pose)].first_view;
  const std::size_t views[] = {shown.top, shown.chosen, shown.best.value_or(shown.chosen)};
  std::array<Picture, 3> pictures;
  for (std::size_t i = 0; i < 3; ++i) {
    const View& view = dataset.views[static_cast<std::size_t>(first) + views[i]];
    const Image image = resized_to_fit(io::read_image(dataset.root / view.path, dataset.exif_orientation), side);
    pictures[i] = {io::encoded_jpeg(image, kJpegQuality), image.width, image.height};
  }
  return pictures;
}

frame::ObjectAxis axis_of_pose(const ViewDataset& dataset, Index pose, frame::DepthChoice depth) {
  const View& top = dataset.views[static_cast<std::size_t>(dataset.top_view(pose))];
  const Image image = io::read_image(dataset.root / top.path, dataset.exif_orientation);
  if (depth == frame::DepthChoice::none) return frame::top_frame(image).axis;
  const DepthImage measured = io::read_depth(train::top_depth_file(dataset, pose));
  return frame::top_frame(image, &measured).axis;
}

}  // namespace

std::vector<ShownPose> shown_poses(const ViewDataset& dataset, const std::vector<ViewPrediction>& predictions,
                                   std::vector<Index>& of_dataset) {
  std::vector<ShownPose> poses;
  for (std::size_t p = 0; p < dataset.poses.size(); ++p) {
    if (!predictions[static_cast<std::size_t>(dataset.poses[p].first_view)].held_out) continue;
    poses.push_back(shown_pose(dataset, dataset.poses[p], predictions));
    of_dataset.push_back(static_cast<Index>(p));
  }
  return poses;
}

std::vector<std::size_t> figure_poses(const std::vector<ShownPose>& poses) {
  std::vector<std::vector<std::size_t>> first_poses;  // [category][object]
  for (std::size_t p = 0; p < poses.size(); ++p) {
    const bool new_category = p == 0 || poses[p].category != poses[p - 1].category;
    if (new_category) first_poses.emplace_back();
    if (new_category || poses[p].object != poses[p - 1].object) first_poses.back().push_back(p);
  }
  std::vector<std::size_t> figures;
  const std::size_t categories = first_poses.size(), taken = std::min(categories, kFigures);
  for (std::size_t object = 0, before = 1; figures.size() != before && figures.size() < kFigures; ++object) {
    before = figures.size();
    for (std::size_t i = 0; i < taken && figures.size() < kFigures; ++i)
      if (const auto& objects = first_poses[i * categories / taken]; object < objects.size())
        figures.push_back(objects[object]);
  }
  std::sort(figures.begin(), figures.end());
  return figures;
}

void add_pictures(const ViewDataset& dataset, const std::vector<Index>& of_dataset, frame::DepthChoice depth,
                  std::vector<ShownPose>& poses, Parallel& parallel) {
  const std::vector<std::size_t> figures = figure_poses(poses);
  const auto is_figure = [&](std::size_t p) { return std::binary_search(figures.begin(), figures.end(), p); };
  parallel.for_chunks(static_cast<Index>(poses.size()), 1, [&](Index begin, Index, int) {
    const auto p = static_cast<std::size_t>(begin);
    ShownPose& pose = poses[p];
    const bool first = p == 0 || pose.category != poses[p - 1].category || pose.object != poses[p - 1].object;
    if (is_figure(p)) pose.axis = axis_of_pose(dataset, of_dataset[p], depth);
    if (is_figure(p) || first)
      pose.pictures = pictures_of(dataset, of_dataset[p], pose, is_figure(p) ? kFigureSide_px : kRowSide_px);
  });
  std::size_t bytes = 0;
  for (const bool figures_first : {true, false})
    for (std::size_t p = 0; p < poses.size(); ++p) {
      if (!poses[p].pictures || is_figure(p) != figures_first) continue;
      for (const Picture& picture : *poses[p].pictures) bytes += picture.jpeg.size();
      if (bytes > kMostPictureBytes) poses[p].pictures.reset();
    }
}

}  // namespace svnet::report
