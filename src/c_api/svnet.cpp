// The C interface to Predictor: checks pointers and sizes, and converts exceptions to a status and a text.
#include "svnet/svnet.h"

#include <algorithm>
#include <mutex>
#include <new>
#include <vector>

#include "base/cpu.h"
#include "base/fixed_threads.h"
#include "base/text.h"
#include "base/version.h"
#include "pixels.h"
#include "predict/predictor.h"

struct svnet_model {
  svnet::predict::Predictor predictor;
};

namespace {

using namespace svnet;
using svnet::predict::Predictor;

/// A fixed buffer, so that storing a message cannot run out of memory.
thread_local char last_error[1024] = "";

svnet_status failed(svnet_status status, const char* text) {
  std::size_t length = 0;
  for (; length + 1 < sizeof last_error && text[length] != '\0'; ++length) last_error[length] = printable(text[length]);
  last_error[length] = '\0';
  return status;
}

/// Runs `body`. Returns SVNET_OK, or the status of the exception that it throws; `user_error` for Error.
template <class Body>
svnet_status guarded(svnet_status user_error, const Body& body) noexcept {
  try {
    body();
    return SVNET_OK;
  } catch (const Error& error) {
    return failed(user_error, error.what());
  } catch (const std::bad_alloc&) {
    return failed(SVNET_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception& error) {
    return failed(SVNET_INTERNAL_ERROR, error.what());
  } catch (...) {
    return failed(SVNET_INTERNAL_ERROR, "unknown exception");
  }
}

/// guarded for bodies that compute; svnet_set_threads waits for them.
template <class Body>
svnet_status computed(svnet_status user_error, const Body& body) noexcept {
  return guarded(user_error, [&] {
    const FixedThreads threads;
    body();
  });
}

/// The choices of the environment. Throws Error for a value that is unknown or not possible on this machine.
InferenceOptions options_from_environment() {
  static std::once_flag once;
  std::call_once(once, cap_from_environment);
  return inference_options_from_environment();
}

void check_given(const void* pointer, const char* function, const char* name) {
  check(pointer != nullptr, "[", function, "] ", name, " is NULL");
}

std::vector<float> scores_of(const char* function, const svnet_model* model, const float* features,
                             const double* poses_deg, std::size_t count) {
  check_given(model, function, "model");
  check_given(features, function, "features");
  if (count == 0) return {};
  check_given(poses_deg, function, "poses_deg");
  std::vector<view::CameraPose> poses;
  if (count > poses.max_size()) throw std::bad_alloc();
  poses.reserve(count);
  for (std::size_t i = 0; i < count; ++i) poses.push_back({poses_deg[2 * i], poses_deg[2 * i + 1]});
  const Predictor& predictor = model->predictor;
  const Index dimension = predictor.feature_count();
  Tensor row = Tensor::empty({1, dimension});
  std::copy_n(features, dimension, row.data<float>());
  return predictor.scores(row, poses);
}

}  // namespace

const char* svnet_version(void) { return kVersion; }

const char* svnet_last_error(void) { return last_error; }

svnet_status svnet_set_threads(int threads) {
  return guarded(SVNET_INVALID_ARGUMENT, [&] { change_threads(threads); });
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
  return computed(SVNET_INVALID_MODEL,
                  [&] { *model = new svnet_model{Predictor(std::filesystem::path(path), options)}; });
}

void svnet_model_free(svnet_model* model) { delete model; }

size_t svnet_feature_count(const svnet_model* model) {
  return model == nullptr ? 0 : static_cast<size_t>(model->predictor.feature_count());
}

int svnet_uses_depth(const svnet_model* model) { return model != nullptr && model->predictor.uses_depth() ? 1 : 0; }

svnet_status svnet_embed_with_depth(const svnet_model* model, const uint8_t* pixels, int32_t height, int32_t width,
                                    size_t stride_bytes, svnet_pixel_format format, const float* depth_m,
                                    float* features) {
  return computed(SVNET_INVALID_ARGUMENT, [&] {
    check_given(model, "svnet_embed_with_depth", "model");
    check_given(pixels, "svnet_embed_with_depth", "pixels");
    check_given(depth_m, "svnet_embed_with_depth", "depth_m");
    check_given(features, "svnet_embed_with_depth", "features");
    const Image top = image_of("svnet_embed_with_depth", pixels, height, width, stride_bytes, format);
    const DepthImage depth = depth_image_of(depth_m, top.height, top.width);
    const Tensor values = model->predictor.embed(top, &depth);
    std::copy_n(values.data<float>(), values.size(), features);
  });
}

svnet_status svnet_embed(const svnet_model* model, const uint8_t* pixels, int32_t height, int32_t width,
                         size_t stride_bytes, svnet_pixel_format format, float* features) {
  return computed(SVNET_INVALID_ARGUMENT, [&] {
    check_given(model, "svnet_embed", "model");
    check_given(pixels, "svnet_embed", "pixels");
    check_given(features, "svnet_embed", "features");
    const Tensor values = model->predictor.embed(image_of("svnet_embed", pixels, height, width, stride_bytes, format));
    std::copy_n(values.data<float>(), values.size(), features);
  });
}

svnet_status svnet_score(const svnet_model* model, const float* features, const double* poses_deg, size_t count,
                         float* scores) {
  return computed(SVNET_INVALID_ARGUMENT, [&] {
    if (count > 0) check_given(scores, "svnet_score", "scores");
    const std::vector<float> values = scores_of("svnet_score", model, features, poses_deg, count);
    std::copy(values.begin(), values.end(), scores);
  });
}

svnet_status svnet_best_view(const svnet_model* model, const float* features, const double* poses_deg, size_t count,
                             size_t* best, float* score) {
  return computed(SVNET_INVALID_ARGUMENT, [&] {
    check_given(best, "svnet_best_view", "best");
    check(count > 0, "[svnet_best_view] count is 0, there is no pose to choose from");
    const std::vector<float> values = scores_of("svnet_best_view", model, features, poses_deg, count);
    *best = predict::best_view(values);
    if (score != nullptr) *score = values[*best];
  });
}
