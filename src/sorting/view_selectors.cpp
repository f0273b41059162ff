#include "sorting/view_selectors.h"

#include <algorithm>

#include "base/error.h"
#include "base/parallel_progress.h"
#include "io/images/depth_file.h"
#include "io/images/image_file.h"
#include "semantics/semantic_scores.h"
#include "sorting/table.h"
#include "train/top_frames.h"

namespace svnet::sorting {
namespace {

std::vector<float> scores_of_pose(const ViewDataset& dataset, Index pose, const predict::Predictor& predictor) {
  const auto file = dataset.root / dataset.views[static_cast<std::size_t>(dataset.top_view(pose))].path;
  std::optional<DepthImage> depth;
  if (predictor.uses_depth()) depth = io::read_depth(train::top_depth_file(dataset, pose));
  const Image top = io::read_image(file, dataset.exif_orientation);
  std::vector<view::CameraPose> poses;
  for (const View& view : dataset.views_of(pose))
    poses.push_back({static_cast<double>(view.theta_deg), static_cast<double>(view.phi_deg)});
  try {
    return predictor.scores(predictor.embed(top, depth ? &*depth : nullptr), poses);
  } catch (const Error& error) {
    fail(file.string(), ": ", error.what());
  }
}

/// Individual scores in problems like the tables.
std::vector<double> semantic_scores_of(const ViewDataset& dataset, std::span<const float> features, std::uint64_t seed,
                                       const Messages& messages, Parallel& parallel) {
  std::vector<std::int64_t> category, object, pose;
  for (const View& view : dataset.views) {
    category.push_back(view.category);
    object.push_back(view.object);
    pose.push_back(view.pose);
  }
  const auto count = std::ssize(dataset.views);
  const auto distances = semantics::squared_distances(features.data(), count, std::ssize(features) / count, parallel);
  const semantics::ClusteringProblems problems(
      category, object, pose,
      {.min_categories = kFewestCategories, .max_categories = kMostCategories, .min_objects = kFewestOfCategory});
  return semantics::semantic_scores(distances, problems, {.problems = kOptProblems, .seed = seed}, parallel, messages)
      .individual;
}

}  // namespace

std::vector<double> predicted_scores(const ViewDataset& dataset, const predict::Predictor& predictor,
                                     const Messages& messages, Parallel& parallel) {
  std::vector<double> predicted(dataset.views.size());
  for_each_with_progress(
      parallel, messages, "predictions of top views", static_cast<Index>(dataset.poses.size()), [&](Index pose) {
        std::ranges::copy(scores_of_pose(dataset, pose, predictor),
                          predicted.begin() + dataset.poses[static_cast<std::size_t>(pose)].first_view);
      });
  return predicted;
}

std::vector<train::Selector> view_selectors(const ViewDataset& dataset, std::span<const float> features,
                                            std::span<const double> predicted, std::uint64_t seed,
                                            const Messages& messages, Parallel& parallel) {
  const auto frames = train::top_frames(dataset, frame::DepthChoice::none, messages, parallel);
  std::vector<train::Selector> selectors{
      {"top", train::top_views(dataset)}, {"rand", {}}, {"broadside", train::broadside_views(dataset, frames)}};
  if (!predicted.empty()) {
    const std::vector<std::int32_t> best = train::best_views(dataset, predicted);
    selectors.push_back({"svnet", best});
    selectors.push_back({"top_svnet", train::views_beside(dataset, train::top_views(dataset), predicted, 2), 2});
    selectors.push_back({"move_50", train::moved_views(dataset, predicted, 0.5)});
    selectors.push_back({train::name_with_views("svnet", 2), train::view_sets(dataset, predicted, 2), 2});
  }
  selectors.push_back(
      {"opt", train::best_views(dataset, semantic_scores_of(dataset, features, seed, messages, parallel))});
  return selectors;
}

}  // namespace svnet::sorting
