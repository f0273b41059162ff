#include "predict/predictor.h"

#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "base/parallel.h"
#include "frame/top_frame.h"
#include "frame/turns.h"
#include "predict/finite_check.h"
#include "view/symmetry.h"

namespace svnet::predict {
namespace {

InferenceOptions options_of(const Model& model, InferenceOptions options) {
  options.int8_dense = options.int8_dense || model.precision == StoredPrecision::int8;
  return options;
}

}  // namespace

Predictor::Predictor(const std::filesystem::path& model_file, const InferenceOptions& options)
    : Predictor(io::read_model(model_file), options) {}

Predictor::Predictor(const Model& model, const InferenceOptions& options)
    : frame_(model.frame),
      preprocessing_(model.preprocessing),
      symmetries_(model.symmetries),
      depth_(model.depth),
      head_(model, options_of(model, options)) {
  if (frame::has_backbone(model.frame))
    backbone_.emplace(model.backbone_graph, model.backbone_parameters, model.backbone_graph.find(model.backbone_output),
                      options_of(model, options));
}

Tensor Predictor::embed(const Image& top, const DepthImage* depth) const {
  check(top.height > 0 && top.width > 0 && static_cast<Index>(top.rgb.size()) == top.height * top.width * 3,
        "[predict] the image says ", top.height, "x", top.width, " pixels and holds ", top.rgb.size(), " bytes");
  check(!uses_depth() || depth != nullptr,
        "[predict] the model was trained with depth; give the depth image of the top view too");
  if (frame_ == frame::FrameChoice::camera) return embedding(top);
  Tensor features = Tensor::empty({1, feature_count()});
  float* to = features.data<float>();
  if (frame::has_axis(frame_)) {
    const frame::TopFrameValues values = frame::to_values(frame::top_frame(top, uses_depth() ? depth : nullptr));
    to = std::copy(values.begin(), values.end(), to);
  }
  if (frame::has_turns(frame_)) {
    const Tensor turns = values_of_turns(top);
    std::copy_n(turns.data<float>(), turns.size(), to);
  }
  return features;
}

Tensor Predictor::embedding(const Image& top) const {
  Tensor batch = Tensor::empty({symmetries_, preprocessing_.height, preprocessing_.width, 3});
  prepare(preprocessing_, top, batch.data<float>());
  for (int symmetry = 1; symmetry < symmetries_; ++symmetry)
    view::apply_symmetry(symmetry, preprocessing_.width, batch.data<float>(),
                         batch.data<float>() + symmetry * preprocessing_.size());
  const Tensor features = backbone_->run({batch});
  check_finite(features.values<float>(), "feature");
  return features.reshaped({1, feature_count()});
}

Tensor Predictor::values_of_turns(const Image& top) const {
  const std::vector<Image> images = frame::turned_images(top, preprocessing_.height);
  // A thread takes two turns through the whole network: it neither waits for others between layers nor shares its cache
  // with a larger batch.
  constexpr Index kAtOnce = 2;
  const Index side = preprocessing_.height, components = element_count(backbone_->output_shape());
  Tensor values = Tensor::empty({frame::kTurns, components});
  Parallel::shared().for_chunks(frame::kTurns, kAtOnce, [&](Index begin, Index end, int) {
    Tensor batch = Tensor::empty({end - begin, side, side, 3});
    for (Index turn = begin; turn < end; ++turn)
      prepare(preprocessing_, images[static_cast<std::size_t>(turn)],
              batch.data<float>() + (turn - begin) * preprocessing_.size());
    const Tensor part = backbone_->run({batch});
    std::copy_n(part.data<float>(), part.size(), values.data<float>() + begin * components);
  });
  check_finite(values.values<float>(), "feature");
  return values;
}

std::vector<float> Predictor::scores(const Tensor& features, std::span<const view::CameraPose> poses) const {
  return head_.scores(features, poses);
}

std::size_t best_view(std::span<const float> scores) {
  check(!scores.empty(), "[predict] there is no pose to choose from");
  return static_cast<std::size_t>(std::max_element(scores.begin(), scores.end()) - scores.begin());
}

std::vector<std::size_t> best_first(std::span<const float> scores) {
  std::vector<std::size_t> order(scores.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return scores[a] > scores[b]; });
  return order;
}

}  // namespace svnet::predict
