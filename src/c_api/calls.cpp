#include "calls.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "guard.h"
#include "log.h"
#include "pixels.h"

namespace svnet {
namespace {

void check_some(const char* function, const Poses& poses) {
  check(poses.count > 0, "[", function, "] count is 0, there is no pose to choose from");
}

/// Puts the poses into the buffers; false if there are none.
bool take_poses(const char* function, const Poses& poses, CallBuffers& buffers) {
  buffers.poses.clear();
  if (poses.count == 0) return false;
  check_given(poses.angles_deg, function, "poses_deg");
  if (poses.count > buffers.poses.max_size()) throw std::bad_alloc();
  buffers.poses.reserve(poses.count);
  for (std::size_t i = 0; i < poses.count; ++i)
    buffers.poses.push_back({poses.angles_deg[2 * i], poses.angles_deg[2 * i + 1]});
  return true;
}

void warn_of_unfamiliar(const svnet_model& model, CallBuffers& buffers) {
  const predict::Familiarity top = model.predictor.familiarity(buffers.features, buffers.workspace);
  if (top.trust < 1)
    log_line(SVNET_LOG_WARNING,
             joined("the object's shape is unlike those that the model was trained on: distance ", top.distance,
                    ", theirs are up to ", top.limit, "; the shape counts ", std::lround(100 * top.trust), " %"));
}

}  // namespace

void embed(const char* function, const svnet_model* model, const Pixels& pixels, const float* depth_m, float* features,
           CallBuffers& buffers) {
  check_given(model, function, "model");
  check_given(pixels.data, function, "pixels");
  check_given(features, function, "features");
  read_pixels(function, pixels.data, pixels.height, pixels.width, pixels.stride_bytes, pixels.format, buffers.image);
  const bool has_depth = depth_m != nullptr && model->predictor.uses_depth();
  if (has_depth) read_depth(depth_m, buffers.image.height, buffers.image.width, buffers.depth);
  buffers.features.resize(static_cast<std::size_t>(model->predictor.feature_count()));
  model->predictor.embed(buffers.image, has_depth ? &buffers.depth : nullptr, buffers.features, buffers.workspace);
  std::ranges::copy(buffers.features, features);
  if (is_logging()) warn_of_unfamiliar(*model, buffers);
}

void score(const char* function, const svnet_model* model, const float* features, const Poses& poses,
           CallBuffers& buffers) {
  check_given(model, function, "model");
  check_given(features, function, "features");
  buffers.scores.clear();
  if (!take_poses(function, poses, buffers)) return;
  buffers.scores.resize(poses.count);
  const auto dimension = static_cast<std::size_t>(model->predictor.feature_count());
  model->predictor.scores(std::span(features, dimension), buffers.poses, buffers.scores, buffers.workspace);
}

void write_scores(const char* function, const svnet_model* model, const float* features, const Poses& poses,
                  float* scores, CallBuffers& buffers) {
  if (poses.count > 0) check_given(scores, function, "scores");
  score(function, model, features, poses, buffers);
  std::ranges::copy(buffers.scores, scores);
}

void write_best_view(const char* function, const svnet_model* model, const float* features, const Poses& poses,
                     std::size_t* best, float* best_score, CallBuffers& buffers) {
  check_given(best, function, "best");
  check_some(function, poses);
  score(function, model, features, poses, buffers);
  *best = predict::best_view(buffers.scores);
  if (best_score != nullptr) *best_score = buffers.scores[*best];
}

void write_best_views(const char* function, const svnet_model* model, const float* features, const Poses& poses,
                      std::size_t most, double min_angle_deg, std::size_t* indices, float* scores, std::size_t* found,
                      CallBuffers& buffers) {
  check_given(indices, function, "indices");
  check_given(found, function, "found");
  check_some(function, poses);
  score(function, model, features, poses, buffers);
  buffers.chosen.resize(std::min(most, poses.count));
  *found = predict::best_views(buffers.scores, buffers.poses, min_angle_deg, buffers.chosen, buffers.nearest);
  for (std::size_t i = 0; i < *found; ++i) {
    indices[i] = buffers.chosen[i];
    if (scores != nullptr) scores[i] = buffers.scores[buffers.chosen[i]];
  }
}

namespace {

/// The scores of the best of the poses, and of the top view.
std::pair<float, float> best_and_top(const char* function, const svnet_model* model, const float* features,
                                     const Poses& poses, CallBuffers& buffers) {
  check_some(function, poses);
  score(function, model, features, poses, buffers);
  const float best = buffers.scores[predict::best_view(buffers.scores)];
  const double top[] = {view::kTopView.theta_deg, view::kTopView.phi_deg};
  score(function, model, features, {top, 1}, buffers);
  return {best, buffers.scores[0]};
}

}  // namespace

void write_margin(const char* function, const svnet_model* model, const float* features, const Poses& poses,
                  float* margin, CallBuffers& buffers) {
  check_given(margin, function, "margin");
  const auto [best, top] = best_and_top(function, model, features, poses, buffers);
  *margin = best - top;
}

void write_gain(const char* function, const svnet_model* model, const float* features, const Poses& poses,
                svnet_gain_estimate* gain, CallBuffers& buffers) {
  check_given(gain, function, "gain");
  const auto [best, top] = best_and_top(function, model, features, poses, buffers);
  const predict::Gain expected = model->predictor.gain(static_cast<double>(best), static_cast<double>(top));
  *gain = {expected.expected, expected.low, expected.high, expected.probability};
}

void write_next_view(const char* function, const svnet_model* model, const float* features, const TakenViews& taken,
                     const Poses& poses, double min_angle_deg, std::size_t* best, float* scores, CallBuffers& buffers) {
  check_given(model, function, "model");
  check_given(features, function, "features");
  check_given(best, function, "best");
  check(taken.count > 0, "[", function, "] taken is 0, no view was taken; the best first one is svnet_best_view's");
  check_given(taken.angles_deg, function, "taken_deg");
  check_given(taken.shapes, function, "taken_shapes");
  check_some(function, poses);
  static_cast<void>(take_poses(function, poses, buffers));
  if (taken.count > buffers.taken.max_size()) throw std::bad_alloc();
  buffers.taken.resize(taken.count);
  for (std::size_t i = 0; i < taken.count; ++i) {
    buffers.taken[i].pose = {taken.angles_deg[2 * i], taken.angles_deg[2 * i + 1]};
    std::copy_n(taken.shapes + i * SVNET_VIEW_SHAPE_SIZE, SVNET_VIEW_SHAPE_SIZE, buffers.taken[i].shape.begin());
  }
  buffers.scores.resize(poses.count);
  const auto dimension = static_cast<std::size_t>(model->predictor.feature_count());
  model->predictor.next_scores(std::span(features, dimension), buffers.taken, buffers.poses, buffers.scores,
                               buffers.workspace);
  *best = predict::next_view(buffers.scores, buffers.poses, buffers.taken, min_angle_deg).value_or(poses.count);
  if (scores != nullptr) std::ranges::copy(buffers.scores, scores);
}

}  // namespace svnet
