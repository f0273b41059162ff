// Contexts: the calls of svnet.cpp with memory that is kept between them.
#include <memory>

#include "calls.h"
#include "guard.h"

struct svnet_context {
  const svnet_model* model;
  svnet::CallBuffers buffers{};
};

namespace {

using namespace svnet;

/// Runs body(model, buffers) of a context.
template <class Body>
svnet_status computed_in(svnet_context* context, const char* function, const Body& body) noexcept {
  return computed(SVNET_INVALID_ARGUMENT, [&] {
    check_given(context, function, "context");
    body(context->model, context->buffers);
  });
}

}  // namespace

svnet_status svnet_context_create(const svnet_model* model, svnet_context** context) {
  return guarded(SVNET_INVALID_ARGUMENT, [&] {
    check_given(context, "svnet_context_create", "context");
    *context = nullptr;
    check_given(model, "svnet_context_create", "model");
    *context = new svnet_context{model};
  });
}

void svnet_context_free(svnet_context* context) { delete context; }

svnet_status svnet_context_embed(svnet_context* context, const uint8_t* pixels, int32_t height, int32_t width,
                                 size_t stride_bytes, svnet_pixel_format format, const float* depth_m,
                                 float* features) {
  constexpr const char* kName = "svnet_context_embed";
  return computed_in(context, kName, [&](const svnet_model* model, CallBuffers& buffers) {
    embed(kName, model, {pixels, height, width, stride_bytes, format}, depth_m, features, buffers);
  });
}

svnet_status svnet_context_score(svnet_context* context, const float* features, const double* poses_deg, size_t count,
                                 float* scores) {
  constexpr const char* kName = "svnet_context_score";
  return computed_in(context, kName, [&](const svnet_model* model, CallBuffers& buffers) {
    write_scores(kName, model, features, {poses_deg, count}, scores, buffers);
  });
}

svnet_status svnet_context_best_view(svnet_context* context, const float* features, const double* poses_deg,
                                     size_t count, size_t* best, float* score) {
  constexpr const char* kName = "svnet_context_best_view";
  return computed_in(context, kName, [&](const svnet_model* model, CallBuffers& buffers) {
    write_best_view(kName, model, features, {poses_deg, count}, best, score, buffers);
  });
}

svnet_status svnet_context_best_views(svnet_context* context, const float* features, const double* poses_deg,
                                      size_t count, size_t k, double min_angle_deg, size_t* indices, float* scores,
                                      size_t* found) {
  constexpr const char* kName = "svnet_context_best_views";
  return computed_in(context, kName, [&](const svnet_model* model, CallBuffers& buffers) {
    write_best_views(kName, model, features, {poses_deg, count}, k, min_angle_deg, indices, scores, found, buffers);
  });
}

svnet_status svnet_context_margin(svnet_context* context, const float* features, const double* poses_deg, size_t count,
                                  float* margin) {
  constexpr const char* kName = "svnet_context_margin";
  return computed_in(context, kName, [&](const svnet_model* model, CallBuffers& buffers) {
    write_margin(kName, model, features, {poses_deg, count}, margin, buffers);
  });
}

svnet_status svnet_context_gain(svnet_context* context, const float* features, const double* poses_deg, size_t count,
                                svnet_gain_estimate* gain) {
  constexpr const char* kName = "svnet_context_gain";
  return computed_in(context, kName, [&](const svnet_model* model, CallBuffers& buffers) {
    write_gain(kName, model, features, {poses_deg, count}, gain, buffers);
  });
}

svnet_status svnet_context_next_view(svnet_context* context, const float* features, const double* taken_deg,
                                     const float* taken_shapes, size_t taken, const double* poses_deg, size_t count,
                                     double min_angle_deg, size_t* best, float* scores) {
  constexpr const char* kName = "svnet_context_next_view";
  return computed_in(context, kName, [&](const svnet_model* model, CallBuffers& buffers) {
    write_next_view(kName, model, features, {taken_deg, taken_shapes, taken}, {poses_deg, count}, min_angle_deg, best,
                    scores, buffers);
  });
}
