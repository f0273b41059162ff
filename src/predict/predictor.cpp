#include "predict/predictor.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "frame/top_frame.h"
#include "frame/turns.h"
#include "predict/finite_check.h"
#include "view/symmetry.h"

namespace svnet::predict {

Predictor::Predictor(const std::filesystem::path& model_file, const InferenceOptions& options)
    : Predictor(io::read_model(model_file), options) {}

Predictor::Predictor(const Model& model, const InferenceOptions& options)
    : frame_(model.frame),
      preprocessing_(model.preprocessing),
      symmetries_(model.symmetries),
      depth_(model.depth),
      gain_(model.gain),
      head_(model, inference_options(model, options)) {
  if (frame::has_backbone(model.frame))
    backbone_.emplace(model.backbone_graph, model.backbone_parameters, model.backbone_graph.find(model.backbone_output),
                      inference_options(model, options));
  if (!model.next_head.nodes().empty()) next_.emplace(model, inference_options(model, options));
}

Tensor Predictor::embed(const Image& top, const DepthImage* depth) const {
  Tensor features = Tensor::empty({1, feature_count()});
  Workspace workspace;
  workspace.head.owns_arenas = false;
  embed(top, depth, {features.data<float>(), static_cast<std::size_t>(features.size())}, workspace);
  return features;
}

void Predictor::embed(const Image& top, const DepthImage* depth, std::span<float> features, Workspace& w) const {
  check(top.height > 0 && top.width > 0 && static_cast<Index>(top.rgb.size()) == top.height * top.width * 3,
        "[predict] the image says ", top.height, "x", top.width, " pixels and holds ", top.rgb.size(), " bytes");
  check(!uses_depth() || depth != nullptr,
        "[predict] the model was trained with depth; give the depth image of the top view too");
  if (frame_ == frame::FrameChoice::camera) return write_embedding(top, features, w);
  float* to = features.data();
  if (frame::has_axis(frame_)) {
    const frame::TopFrameValues values = frame::to_values(frame::top_frame(top, uses_depth() ? depth : nullptr));
    to = std::copy(values.begin(), values.end(), to);
  }
  if (frame::has_turns(frame_)) {
    const Tensor turns = values_of_turns(top);
    std::copy_n(turns.data<float>(), turns.size(), to);
  }
}

void Predictor::write_embedding(const Image& top, std::span<float> features, Workspace& w) const {
  if (!w.images.defined()) w.images = Tensor::empty({symmetries_, preprocessing_.height, preprocessing_.width, 3});
  float* const images = w.images.data<float>();
  prepare(preprocessing_, top, images, w.resizing);
  for (int symmetry = 1; symmetry < symmetries_; ++symmetry)
    view::apply_symmetry(symmetry, preprocessing_.width, images, images + symmetry * preprocessing_.size());
  const float* const input = images;
  backbone_->run({&input, 1}, symmetries_, features.data(), w.head.arena(w.backbone));
  check_finite(features, "feature");
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

std::vector<float> Predictor::next_scores(const Tensor& features, std::span<const frame::TakenView> taken,
                                          std::span<const view::CameraPose> poses) const {
  check(features.defined() && features.dtype() == DType::f32, "[predict] features are not float32");
  std::vector<float> result(poses.size());
  Workspace workspace;
  workspace.head.owns_arenas = false;
  next_scores(features.values<float>(), taken, poses, result, workspace);
  return result;
}

void Predictor::next_scores(std::span<const float> features, std::span<const frame::TakenView> taken,
                            std::span<const view::CameraPose> poses, std::span<float> scores,
                            Workspace& workspace) const {
  check(next_.has_value(),
        "[predict] the model does not know which view to take next; it must be trained with sv_net.next_view: ridge");
  check(static_cast<Index>(features.size()) == feature_count(), "[predict] there are ", features.size(),
        " features, the model expects ", feature_count());
  const double trust = familiarity(features, workspace).trust;
  workspace.next.owns_arenas = workspace.head.owns_arenas;
  next_->scores(features, trust, taken, poses, scores, workspace.next);
}

std::string Predictor::description() const {
  std::string text = joined("frame ", name_of(frame_), ", ", feature_count(), " features");
  if (!backbone_) return text;
  std::map<std::string, int> counts;
  for (const std::string& kernel : backbone_->kernels()) ++counts[kernel];
  text += joined(", ", name_of(backbone_->precision()), "; backbone:");
  const char* separator = " ";
  for (const auto& [kernel, count] : counts) text += joined(std::exchange(separator, ", "), count, " x ", kernel);
  return text;
}

void Predictor::scores(std::span<const float> features, std::span<const view::CameraPose> poses,
                       std::span<float> scores, Workspace& workspace) const {
  head_.scores(features, poses, scores, workspace.head);
}

Familiarity Predictor::familiarity(std::span<const float> features, Workspace& workspace) const {
  return head_.familiarity(features, workspace.head);
}

}  // namespace svnet::predict
