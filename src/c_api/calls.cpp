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
  buffers.poses.clear();
  buffers.scores.clear();
  if (poses.count == 0) return;
  check_given(poses.angles_deg, function, "poses_deg");
  if (poses.count > buffers.poses.max_size()) throw std::bad_alloc();
  buffers.poses.reserve(poses.count);
  for (std::size_t i = 0; i < poses.count; ++i)
    buffers.poses.push_back({poses.angles_deg[2 * i], poses.angles_deg[2 * i + 1]});
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

void write_margin(const char* function, const svnet_model* model, const float* features, const Poses& poses,
                  float* margin, CallBuffers& buffers) {
  check_given(margin, function, "margin");
  check_some(function, poses);
  score(function, model, features, poses, buffers);
  const float best = buffers.scores[predict::best_view(buffers.scores)];
  const double top[] = {view::kTopView.theta_deg, view::kTopView.phi_deg};
  score(function, model, features, {top, 1}, buffers);
  *margin = best - buffers.scores[0];
}

}  // namespace svnet
