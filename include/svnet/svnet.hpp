// The C++17 interface of svnet: svnet.h with exceptions and ownership. Header-only, so that the caller may use another
// compiler and standard library than those that built libsvnet.
//
//   svnet::ViewModel model("model.safetensors");
//   const std::vector<float> features = model.embed({pixels, height, width});
//   const svnet::CameraPose poses[] = {{0, 45}, {90, 60}};
//   const svnet::BestView best = model.best_view(features, poses, 2);
//
// svnet.h describes units, ranges and thread safety.
#ifndef SVNET_SVNET_HPP
#define SVNET_SVNET_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "svnet/svnet.h"

namespace svnet {
inline namespace v0 {

// A failure of a function of svnet.h: its status and one line of text.
class StatusError : public std::runtime_error {
 public:
  StatusError(svnet_status status, const std::string& text) : std::runtime_error(text), status_(status) {}
  svnet_status status() const { return status_; }

 private:
  svnet_status status_;
};

// A camera pose in degrees.
struct CameraPose {
  double theta_deg, phi_deg;
};
static_assert(sizeof(CameraPose) == 2 * sizeof(double), "poses are passed as pairs of doubles");

// Pixels that the caller owns. stride_bytes: as for svnet_embed; 0: rows without gaps.
struct ImageView {
  const std::uint8_t* pixels;
  std::int32_t height, width;
  svnet_pixel_format format = SVNET_RGB8;
  std::size_t stride_bytes = 0;
};

struct BestView {
  std::size_t index;  // of the pose with the highest score, the first one in a tie
  float score;
};

// A grid of poses, as svnet_grid writes it.
struct GridSpec {
  std::int32_t theta_steps = 36, phi_steps = 10;
  double lowest_phi_deg = 0, highest_phi_deg = 90;
};

namespace detail {

inline void check(svnet_status status) {
  if (status == SVNET_OUT_OF_MEMORY) throw std::bad_alloc();
  if (status != SVNET_OK) throw StatusError(status, svnet_last_error());
}

inline std::size_t pixel_bytes(svnet_pixel_format format) {
  return format == SVNET_GRAY8 ? 1 : format == SVNET_RGBA8 || format == SVNET_BGRA8 ? 4 : 3;
}

inline std::size_t stride_of(const ImageView& image) {
  if (image.stride_bytes != 0) return image.stride_bytes;
  return static_cast<std::size_t>(image.width) * pixel_bytes(image.format);
}

}  // namespace detail

inline std::string version() { return svnet_version(); }

inline void set_threads(int threads) { detail::check(svnet_set_threads(threads)); }

inline void set_log(svnet_log_callback callback, void* user_data = nullptr) {
  detail::check(svnet_set_log(callback, user_data));
}

inline std::vector<CameraPose> pose_grid(const GridSpec& spec) {
  const auto grid = [&](double* poses_deg, std::size_t capacity) {
    std::size_t count = 0;
    detail::check(svnet_grid(spec.theta_steps, spec.phi_steps, spec.lowest_phi_deg, spec.highest_phi_deg, poses_deg,
                             capacity, &count));
    return count;
  };
  std::vector<CameraPose> poses(grid(nullptr, 0));
  grid(&poses.data()->theta_deg, poses.size());
  return poses;
}

// Items in groups: the group of each, numbered from 0, and how many groups there are.
struct Groups {
  std::vector<std::int32_t> labels;
  std::size_t count;
};

// Puts `rows` items into groups of like items: svnet_group. `features` has as many floats for each item, one item after
// the other. groups 0: their number is estimated.
inline Groups group(const std::vector<float>& features, std::size_t rows, std::size_t groups = 0) {
  if (rows == 0 || features.size() % rows != 0)
    throw StatusError(SVNET_INVALID_ARGUMENT, "there are " + std::to_string(features.size()) +
                                                  " features, which is no " + "whole number for each of " +
                                                  std::to_string(rows) + " rows");
  Groups result{std::vector<std::int32_t>(rows), 0};
  detail::check(
      svnet_group(features.data(), rows, features.size() / rows, groups, result.labels.data(), &result.count));
  return result;
}

// What the picture of a view shows of the object's shape: svnet_view_shape.
using ViewShape = std::array<float, SVNET_VIEW_SHAPE_SIZE>;

inline ViewShape view_shape(const ImageView& picture) {
  ViewShape shape{};
  detail::check(svnet_view_shape(picture.pixels, picture.height, picture.width, detail::stride_of(picture),
                                 picture.format, shape.data()));
  return shape;
}

// A view that was taken, and what its picture shows.
struct TakenView {
  CameraPose pose;
  ViewShape shape;
};

// A pose to take next, as an index of the candidates, and the scores of all of them.
struct NextView {
  std::size_t index;
  std::vector<float> scores;
};

// A trained model; movable, not copyable. All functions throw StatusError or std::bad_alloc if svnet.h fails.
class ViewModel {
 public:
  explicit ViewModel(const std::string& path) {
    svnet_model* model = nullptr;
    detail::check(svnet_model_load(path.c_str(), &model));
    model_.reset(model);
  }

  std::size_t feature_count() const { return svnet_feature_count(model_.get()); }

  // Returns the feature_count() features of a top image.
  std::vector<float> embed(const ImageView& image) const {
    std::vector<float> features(feature_count());
    detail::check(svnet_embed(model_.get(), image.pixels, image.height, image.width, stride_of(image), image.format,
                              features.data()));
    return features;
  }

  bool uses_depth() const { return svnet_uses_depth(model_.get()) != 0; }

  // The same with the depth of the top view in metres, height * width floats as for svnet_embed_with_depth.
  std::vector<float> embed(const ImageView& image, const std::vector<float>& depth_m) const {
    if (image.height < 0 || image.width < 0 ||
        depth_m.size() != static_cast<std::size_t>(image.height) * static_cast<std::size_t>(image.width))
      throw StatusError(SVNET_INVALID_ARGUMENT, "there are " + std::to_string(depth_m.size()) +
                                                    " depth values, the image has " + std::to_string(image.height) +
                                                    "x" + std::to_string(image.width) + " pixels");
    std::vector<float> features(feature_count());
    detail::check(svnet_embed_with_depth(model_.get(), image.pixels, image.height, image.width, stride_of(image),
                                         image.format, depth_m.data(), features.data()));
    return features;
  }

  std::vector<float> scores(const std::vector<float>& features, const CameraPose* poses, std::size_t count) const {
    std::vector<float> result(count);
    detail::check(svnet_score(model_.get(), numbers(features), angles(poses), count, result.data()));
    return result;
  }
  std::vector<float> scores(const std::vector<float>& features, const std::vector<CameraPose>& poses) const {
    return scores(features, poses.data(), poses.size());
  }

  BestView best_view(const std::vector<float>& features, const CameraPose* poses, std::size_t count) const {
    BestView best{};
    detail::check(svnet_best_view(model_.get(), numbers(features), angles(poses), count, &best.index, &best.score));
    return best;
  }
  BestView best_view(const std::vector<float>& features, const std::vector<CameraPose>& poses) const {
    return best_view(features, poses.data(), poses.size());
  }

  // Up to k poses that differ by at least min_angle_deg, best first: svnet_best_views.
  std::vector<BestView> best_views(const std::vector<float>& features, const CameraPose* poses, std::size_t count,
                                   std::size_t k, double min_angle_deg) const {
    const std::size_t most = k < count ? k : count;
    std::vector<std::size_t> indices(most + 1);  // never without an address
    std::vector<float> scores(most + 1);
    std::size_t found = 0;
    detail::check(svnet_best_views(model_.get(), numbers(features), angles(poses), count, k, min_angle_deg,
                                   indices.data(), scores.data(), &found));
    std::vector<BestView> views;
    for (std::size_t i = 0; i < found; ++i) views.push_back({indices[i], scores[i]});
    return views;
  }
  std::vector<BestView> best_views(const std::vector<float>& features, const std::vector<CameraPose>& poses,
                                   std::size_t k, double min_angle_deg) const {
    return best_views(features, poses.data(), poses.size(), k, min_angle_deg);
  }

  // The highest score minus that of the top view: svnet_margin.
  float margin(const std::vector<float>& features, const std::vector<CameraPose>& poses) const {
    float result = 0;
    detail::check(svnet_margin(model_.get(), numbers(features), angles(poses.data()), poses.size(), &result));
    return result;
  }

  // What moving to the best of the poses is expected to gain: svnet_gain.
  svnet_gain_estimate gain(const std::vector<float>& features, const std::vector<CameraPose>& poses) const {
    svnet_gain_estimate result{};
    detail::check(svnet_gain(model_.get(), numbers(features), angles(poses.data()), poses.size(), &result));
    return result;
  }

  bool knows_next_view() const { return svnet_knows_next_view(model_.get()) != 0; }

  // The pose to take next when views of the object were taken, at least min_angle_deg from each of them, and the scores
  // of all candidates: svnet_next_view. `index` is poses.size() if none differs enough.
  NextView next_view(const std::vector<float>& features, const std::vector<TakenView>& taken,
                     const std::vector<CameraPose>& poses, double min_angle_deg = 0) const {
    std::vector<CameraPose> taken_poses;
    std::vector<float> shapes;
    for (const TakenView& view : taken) {
      taken_poses.push_back(view.pose);
      shapes.insert(shapes.end(), view.shape.begin(), view.shape.end());
    }
    NextView next{0, std::vector<float>(poses.size())};
    detail::check(svnet_next_view(model_.get(), numbers(features), angles(taken_poses.data()), shapes.data(),
                                  taken.size(), angles(poses.data()), poses.size(), min_angle_deg, &next.index,
                                  next.scores.data()));
    return next;
  }

 private:
  friend class ViewContext;

  struct Free {
    void operator()(svnet_model* model) const { svnet_model_free(model); }
  };

  static std::size_t stride_of(const ImageView& image) { return detail::stride_of(image); }

  const float* numbers(const std::vector<float>& features) const {
    if (features.size() != feature_count())
      throw StatusError(SVNET_INVALID_ARGUMENT, "there are " + std::to_string(features.size()) +
                                                    " features, the model expects " + std::to_string(feature_count()));
    return features.data();
  }
  static const double* angles(const CameraPose* poses) { return poses == nullptr ? nullptr : &poses->theta_deg; }

  std::unique_ptr<svnet_model, Free> model_;
};

// Memory of calls with one model, which must live longer: see svnet_context_create. Movable, not copyable; used by one
// thread at a time. Its functions write into the caller's memory, so that they allocate nothing after the first calls.
class ViewContext {
 public:
  explicit ViewContext(const ViewModel& model) {
    svnet_context* context = nullptr;
    detail::check(svnet_context_create(model.model_.get(), &context));
    context_.reset(context);
  }

  // `features` receives ViewModel::feature_count() floats. depth_m: as for svnet_context_embed.
  void embed(const ImageView& image, float* features, const float* depth_m = nullptr) {
    detail::check(svnet_context_embed(context_.get(), image.pixels, image.height, image.width,
                                      ViewModel::stride_of(image), image.format, depth_m, features));
  }
  // `scores` receives `count` floats.
  void scores(const float* features, const CameraPose* poses, std::size_t count, float* scores) {
    detail::check(svnet_context_score(context_.get(), features, ViewModel::angles(poses), count, scores));
  }
  BestView best_view(const float* features, const CameraPose* poses, std::size_t count) {
    BestView best{};
    detail::check(
        svnet_context_best_view(context_.get(), features, ViewModel::angles(poses), count, &best.index, &best.score));
    return best;
  }
  // `indices` and, unless nullptr, `scores` have room for the smaller of k and count. Returns how many were found.
  std::size_t best_views(const float* features, const CameraPose* poses, std::size_t count, std::size_t k,
                         double min_angle_deg, std::size_t* indices, float* scores = nullptr) {
    std::size_t found = 0;
    detail::check(svnet_context_best_views(context_.get(), features, ViewModel::angles(poses), count, k, min_angle_deg,
                                           indices, scores, &found));
    return found;
  }
  float margin(const float* features, const CameraPose* poses, std::size_t count) {
    float result = 0;
    detail::check(svnet_context_margin(context_.get(), features, ViewModel::angles(poses), count, &result));
    return result;
  }
  svnet_gain_estimate gain(const float* features, const CameraPose* poses, std::size_t count) {
    svnet_gain_estimate result{};
    detail::check(svnet_context_gain(context_.get(), features, ViewModel::angles(poses), count, &result));
    return result;
  }

 private:
  struct Free {
    void operator()(svnet_context* context) const { svnet_context_free(context); }
  };
  std::unique_ptr<svnet_context, Free> context_;
};

}  // namespace v0
}  // namespace svnet

#endif  // SVNET_SVNET_HPP
