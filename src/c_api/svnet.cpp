// The C interface to Predictor: models, and calls without a context.
#include "svnet/svnet.h"

#include <algorithm>
#include <chrono>
#include <mutex>

#include "base/cpu.h"
#include "base/parallel.h"
#include "base/version.h"
#include "calls.h"
#include "guard.h"
#include "log.h"
#include "pixels.h"

namespace {

using namespace svnet;
using svnet::predict::Predictor;

/// The choices of the environment. Throws Error for a value that is unknown or not possible on this machine.
InferenceOptions options_from_environment() {
  static std::once_flag once;
  std::call_once(once, cap_from_environment);
  return inference_options_from_environment();
}

void log_loaded(const char* path, const Predictor& predictor, std::chrono::steady_clock::duration time) {
  const auto sets = instruction_sets();
  log_line(SVNET_LOG_INFO,
           joined(path, ": loaded in ", std::chrono::duration<double, std::milli>(time).count(), " ms; threads ",
                  Parallel::shared().threads(), ", instruction set ", sets.empty() ? "none" : sets.front()));
  log_line(SVNET_LOG_INFO, joined(path, ": ", predictor.description()));
}

}  // namespace

const char* svnet_version(void) { return kVersion; }

const char* svnet_last_error(void) { return last_failure(); }

svnet_status svnet_set_threads(int threads) {
  return guarded(SVNET_INVALID_ARGUMENT, [&] {
    change_threads(threads);
    if (is_logging()) log_line(SVNET_LOG_INFO, joined("threads ", threads));
  });
}

svnet_status svnet_model_load(const char* path, svnet_model** model) {
  InferenceOptions options;
  const svnet_status arguments = guarded(SVNET_INVALID_ARGUMENT, [&] {
    check_given(model, "svnet_model_load", "model");
    *model = nullptr;
    check_given(path, "svnet_model_load", "path");
    options = options_from_environment();
  });
  if (arguments != SVNET_OK) return arguments;
  return computed(SVNET_INVALID_MODEL, [&] {
    const auto begin = std::chrono::steady_clock::now();
    std::unique_ptr<svnet_model> loaded(new svnet_model{Predictor(std::filesystem::path(path), options)});
    if (is_logging()) log_loaded(path, loaded->predictor, std::chrono::steady_clock::now() - begin);
    *model = loaded.release();
  });
}

void svnet_model_free(svnet_model* model) { delete model; }

size_t svnet_feature_count(const svnet_model* model) {
  return model == nullptr ? 0 : static_cast<size_t>(model->predictor.feature_count());
}

int svnet_uses_depth(const svnet_model* model) { return model != nullptr && model->predictor.uses_depth() ? 1 : 0; }

svnet_status svnet_embed(const svnet_model* model, const uint8_t* pixels, int32_t height, int32_t width,
                         size_t stride_bytes, svnet_pixel_format format, float* features) {
  return computed(SVNET_INVALID_ARGUMENT, [&] {
    CallBuffers buffers = single_call();
    embed("svnet_embed", model, {pixels, height, width, stride_bytes, format}, nullptr, features, buffers);
  });
}

svnet_status svnet_embed_with_depth(const svnet_model* model, const uint8_t* pixels, int32_t height, int32_t width,
                                    size_t stride_bytes, svnet_pixel_format format, const float* depth_m,
                                    float* features) {
  return computed(SVNET_INVALID_ARGUMENT, [&] {
    check_given(depth_m, "svnet_embed_with_depth", "depth_m");
    CallBuffers buffers = single_call();
    embed("svnet_embed_with_depth", model, {pixels, height, width, stride_bytes, format}, depth_m, features, buffers);
  });
}

svnet_status svnet_score(const svnet_model* model, const float* features, const double* poses_deg, size_t count,
                         float* scores) {
  return computed(SVNET_INVALID_ARGUMENT, [&] {
    CallBuffers buffers = single_call();
    write_scores("svnet_score", model, features, {poses_deg, count}, scores, buffers);
  });
}

svnet_status svnet_best_view(const svnet_model* model, const float* features, const double* poses_deg, size_t count,
                             size_t* best, float* score) {
  return computed(SVNET_INVALID_ARGUMENT, [&] {
    CallBuffers buffers = single_call();
    write_best_view("svnet_best_view", model, features, {poses_deg, count}, best, score, buffers);
  });
}

svnet_status svnet_best_views(const svnet_model* model, const float* features, const double* poses_deg, size_t count,
                              size_t k, double min_angle_deg, size_t* indices, float* scores, size_t* found) {
  return computed(SVNET_INVALID_ARGUMENT, [&] {
    CallBuffers buffers = single_call();
    write_best_views("svnet_best_views", model, features, {poses_deg, count}, k, min_angle_deg, indices, scores, found,
                     buffers);
  });
}

svnet_status svnet_gain(const svnet_model* model, const float* features, const double* poses_deg, size_t count,
                        svnet_gain_estimate* gain) {
  return computed(SVNET_INVALID_ARGUMENT, [&] {
    CallBuffers buffers = single_call();
    write_gain("svnet_gain", model, features, {poses_deg, count}, gain, buffers);
  });
}

svnet_status svnet_margin(const svnet_model* model, const float* features, const double* poses_deg, size_t count,
                          float* margin) {
  return computed(SVNET_INVALID_ARGUMENT, [&] {
    CallBuffers buffers = single_call();
    write_margin("svnet_margin", model, features, {poses_deg, count}, margin, buffers);
  });
}

svnet_status svnet_view_shape(const uint8_t* pixels, int32_t height, int32_t width, size_t stride_bytes,
                              svnet_pixel_format format, float* shape) {
  constexpr const char* kName = "svnet_view_shape";
  static_assert(SVNET_VIEW_SHAPE_SIZE == svnet::frame::kViewShapeSize);
  return computed(SVNET_INVALID_ARGUMENT, [&] {
    check_given(pixels, kName, "pixels");
    check_given(shape, kName, "shape");
    Image image;
    read_pixels(kName, pixels, height, width, stride_bytes, format, image);
    std::ranges::copy(frame::view_shape(image), shape);
  });
}

int svnet_knows_next_view(const svnet_model* model) {
  return model != nullptr && model->predictor.knows_next_view() ? 1 : 0;
}

svnet_status svnet_next_view(const svnet_model* model, const float* features, const double* taken_deg,
                             const float* taken_shapes, size_t taken, const double* poses_deg, size_t count,
                             double min_angle_deg, size_t* best, float* scores) {
  return computed(SVNET_INVALID_ARGUMENT, [&] {
    CallBuffers buffers = single_call();
    write_next_view("svnet_next_view", model, features, {taken_deg, taken_shapes, taken}, {poses_deg, count},
                    min_angle_deg, best, scores, buffers);
  });
}
