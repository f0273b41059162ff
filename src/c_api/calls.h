#pragma once
#include <span>
#include <vector>

#include "predict/predictor.h"
#include "svnet/svnet.h"

struct svnet_model {
  svnet::predict::Predictor predictor;
};

// What the functions of svnet.h do, with and without a context. Messages begin with the name of the function.
namespace svnet {

/// The memory of calls, one at a time, with one model.
struct CallBuffers {
  Image image{};
  DepthImage depth{};
  std::vector<float> features{}, scores{};
  std::vector<view::CameraPose> poses{};
  std::vector<std::size_t> chosen{};
  std::vector<double> nearest{};
  std::vector<frame::TakenView> taken{};
  predict::Workspace workspace{};
};

/// Buffers for a single call.
inline CallBuffers single_call() {
  CallBuffers buffers;
  buffers.workspace.head.owns_arenas = false;
  return buffers;
}

struct Pixels {
  const std::uint8_t* data;
  std::int32_t height, width;
  std::size_t stride_bytes;
  svnet_pixel_format format;
};

struct Poses {
  const double* angles_deg;
  std::size_t count;
};

/// `depth_m` may be nullptr. Writes `features` if nothing is thrown.
void embed(const char* function, const svnet_model* model, const Pixels& pixels, const float* depth_m, float* features,
           CallBuffers& buffers);

/// One score per pose, in buffers.scores.
void score(const char* function, const svnet_model* model, const float* features, const Poses& poses,
           CallBuffers& buffers);

void write_scores(const char* function, const svnet_model* model, const float* features, const Poses& poses,
                  float* scores, CallBuffers& buffers);
void write_best_view(const char* function, const svnet_model* model, const float* features, const Poses& poses,
                     std::size_t* best, float* score, CallBuffers& buffers);
void write_best_views(const char* function, const svnet_model* model, const float* features, const Poses& poses,
                      std::size_t most, double min_angle_deg, std::size_t* indices, float* scores, std::size_t* found,
                      CallBuffers& buffers);
void write_margin(const char* function, const svnet_model* model, const float* features, const Poses& poses,
                  float* margin, CallBuffers& buffers);
void write_gain(const char* function, const svnet_model* model, const float* features, const Poses& poses,
                svnet_gain_estimate* gain, CallBuffers& buffers);

/// Views that were taken: 2 doubles, and SVNET_VIEW_SHAPE_SIZE floats, of each.
struct TakenViews {
  const double* angles_deg;
  const float* shapes;
  std::size_t count;
};

void write_next_view(const char* function, const svnet_model* model, const float* features, const TakenViews& taken,
                     const Poses& poses, double min_angle_deg, std::size_t* best, float* scores, CallBuffers& buffers);

}  // namespace svnet
