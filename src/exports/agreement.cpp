#include "exports/agreement.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "base/error.h"
#include "frame/next_inputs.h"
#include "predict/predictor.h"

namespace svnet::exports {
namespace {

constexpr Index kSamples = 4, kPoses = 20;

/// Waves of colour with a disc, differently for each number. Somewhat larger than what the model takes.
Image drawing(Index number, Index height, Index width) {
  Image image{height, width, {}};
  const double phase = 0.7 * static_cast<double>(number + 1);
  for (Index y = 0; y < height; ++y)
    for (Index x = 0; x < width; ++x) {
      const double u = static_cast<double>(x) / static_cast<double>(width) - 0.5,
                   v = static_cast<double>(y) / static_cast<double>(height) - 0.5;
      const bool inside = std::hypot(u - 0.1 * std::sin(phase), v - 0.1 * std::cos(phase)) < 0.25;
      for (int c = 0; c < 3; ++c) {
        const double wave = std::sin(20 * u * std::cos(phase + c) + 16 * v * std::sin(2 * phase - c) + c);
        const double value = 128 + 80 * wave + (inside ? 60 - 50 * c : 0);
        image.rgb.push_back(static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0)));
      }
    }
  return image;
}

/// Spread over the upper half-sphere, at azimuths in [0, 360).
std::vector<view::CameraPose> poses() {
  std::vector<view::CameraPose> poses;
  constexpr double kGoldenAngle = 137.50776405;
  for (Index i = 0; i < kPoses; ++i)
    poses.push_back({std::fmod(kGoldenAngle * static_cast<double>(i), 360.0), 5 + 4.25 * static_cast<double>(i)});
  return poses;
}

/// Numbers of about the size that a head's inputs have.
Tensor made_up_inputs(Index number, Index rows, Index columns) {
  Tensor inputs = Tensor::empty({rows, columns});
  for (Index i = 0; i < inputs.size(); ++i)
    inputs.data<float>()[i] =
        static_cast<float>(std::sin(1.7 * static_cast<double>(i + 1) + static_cast<double>(number)));
  return inputs;
}

/// The model itself.
class Original {
 public:
  Original(const Model& model, ModelPart part) : model_(model), part_(part) {
    if (part == ModelPart::backbone)
      network_.emplace(model.backbone_graph, model.backbone_parameters,
                       model.backbone_graph.find(model.backbone_output));
    else if (part == ModelPart::next)
      network_.emplace(model.next_head, model.next_parameters, model.next_head.output());
    else if (model.frame == frame::FrameChoice::camera)
      predictor_.emplace(model);
    else
      network_.emplace(model.head, model.head_parameters, model.head.output());
  }

  Sample sample(Index number) const {
    Sample sample{.picture = {}, .poses = poses()};
    if (frame::has_backbone(model_.frame)) {
      const models::Preprocessing& p = model_.preprocessing;
      sample.picture = drawing(number, p.height + p.height / 4, p.width + p.width / 3);
    }
    if (part_ == ModelPart::next)
      sample.pose_inputs = made_up_inputs(number, kPoses, frame::next_input_count(frame_spec(model_)));
    if (part_ == ModelPart::head && predictor_) sample.features = predictor_->embed(sample.picture);
    if (part_ == ModelPart::head && !predictor_)
      sample.pose_inputs = made_up_inputs(number, kPoses, frame::input_count(frame_spec(model_)));
    return sample;
  }

  std::vector<float> values(const Sample& sample) const {
    if (predictor_)
      return predictor_->scores(sample.features.defined() ? sample.features : predictor_->embed(sample.picture),
                                sample.poses);
    Tensor input = sample.pose_inputs;
    if (part_ == ModelPart::backbone) input = network_picture(model_, sample.picture, false);
    const Tensor output = network_->run({input});
    return {output.data<float>(), output.data<float>() + output.size()};
  }

 private:
  const Model& model_;
  ModelPart part_;
  std::optional<predict::Predictor> predictor_;
  std::optional<Inference> network_;
};

double largest(const std::vector<float>& values) {
  double most = 0;
  for (const float value : values) most = std::max(most, static_cast<double>(std::abs(value)));
  return most;
}

}  // namespace

std::string Agreement::text(double bound) const {
  std::ostringstream text;
  text << samples << " pictures x " << poses << " poses: largest difference " << std::setprecision(2)
       << largest_difference << " (bound " << bound << ")";
  if (poses > 0) text << ", the same best pose in " << same_best << " of " << samples;
  return text.str();
}

Agreement agreement(const std::string& name, const Model& model, ModelPart part, const ExportedPart& exported,
                    double bound) {
  const Original original(model, part);
  const bool are_scores = part != ModelPart::backbone;
  Agreement result{.samples = kSamples, .poses = are_scores ? kPoses : 0};
  for (Index i = 0; i < kSamples; ++i) {
    const Sample sample = original.sample(i);
    const std::vector<float> wanted = original.values(sample), got = exported(sample);
    check(wanted.size() == got.size(), name, ": the export gives ", got.size(), " values, the model ", wanted.size());
    const double scale = are_scores ? 1 : std::max(largest(wanted), 1e-30);
    for (std::size_t j = 0; j < wanted.size(); ++j) {
      const double difference = std::abs(static_cast<double>(got[j]) - static_cast<double>(wanted[j])) / scale;
      // In this order NaN is the largest.
      if (!(difference <= result.largest_difference)) result.largest_difference = difference;
    }
    if (are_scores && predict::best_view(wanted) == predict::best_view(got)) ++result.same_best;
  }
  check(result.largest_difference <= bound, name,
        ": the export does not compute what the model computes: ", result.text(bound), "; nothing was written");
  return result;
}

void check_part(const Model& model, ModelPart part) {
  if (part == ModelPart::next) {
    check(!model.next_head.nodes().empty(),
          "[export] the model does not know which view to take next; it must be trained with sv_net.next_view: ridge");
    return;
  }
  check(frame::has_backbone(model.frame) || part == ModelPart::head, "[export] the model is in the frame ",
        name_of(model.frame), ", which has no network for the image; export its head with --part head");
  check(model.frame == frame::FrameChoice::camera || part != ModelPart::all, "[export] the model is in the frame ",
        name_of(model.frame),
        ", whose inputs are computed outside the networks; export these with --part backbone and --part head");
}

Tensor network_picture(const Model& model, const Image& picture, bool raw) {
  models::Preprocessing p = model.preprocessing;
  if (raw) p.mode = models::PixelMode::none;
  Tensor prepared = Tensor::empty({1, p.height, p.width, 3});
  prepare(p, picture, prepared.data<float>());
  return prepared;
}

double bound_of(StoredPrecision precision) {
  switch (precision) {
    case StoredPrecision::f32:
      return 1e-5;
    case StoredPrecision::bf16:
      return 5e-3;
    case StoredPrecision::int8:
      return 2e-2;
  }
  return 0;
}

}  // namespace svnet::exports
