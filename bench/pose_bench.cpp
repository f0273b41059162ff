// From a top image to the scores of camera poses, by models with made-up weights.
//   backbone/<frame>/<backbone>          the features of one top image alone
//   whole_call/<frame>/<backbone>/poses  features, then the scores of that many poses and the best of them
//   head/<frame>/<backbone>/<precision>  the scores of one pose from features
// SVNET_BENCH_MODEL=FILE: the same of a trained model, as backbone/file, whole_call/file and head/file.
// Batch norms have the statistics of their inputs, as in a trained network.
// In the frame `camera` the name of the backbone is followed by the width of the head, 4096 by default.
// VGG19 in the frame `camera` is the paper's network: its head has 153 million weights.
#include <benchmark/benchmark.h>

#include "base/environment.h"
#include "base/random.h"
#include "io/models/model_file.h"
#include "models/backbone.h"
#include "models/pose_head.h"
#include "models/turned_backbone.h"
#include "nn/graph/run.h"
#include "predict/predictor.h"
#include "view/pose_grid.h"

namespace svnet {
namespace {

/// Gives the batch norms of a head of the frame `camera` the statistics of what they read, as training does: elements
/// of a hidden layer then change their sign with the pose as seldom as in a trained network.
void learn_statistics(Model& model) {
  constexpr Index kSamples = 64;
  const Index features = element_count(model.head.node(model.head.inputs()[0]).shape);
  const auto poses = view::fibonacci_half_sphere(kSamples, 0);
  RandomStream random(1, Stream::weights);
  Tensor x = Tensor::empty({kSamples, features}), angles = Tensor::empty({kSamples, angle_count(model.angles)});
  for (Index i = 0; i < x.size(); ++i) x.data<float>()[i] = static_cast<float>(std::max(0.0, random.normal()));
  for (Index i = 0; i < kSamples; ++i) {
    const auto& pose = poses[static_cast<std::size_t>(i * 37 % kSamples)];
    encode_angles(model.angles, pose.theta_deg, pose.phi_deg, angles.data<float>() + i * angles.dim(1));
  }
  for (const auto& node : model.head.nodes()) {
    if (!node.is<BatchNormLayer>()) continue;
    const Tensor read = run_inference(model.head, model.head_parameters, {x, angles}, {node.inputs[0]})[0];
    const Index units = read.dim(1);
    Tensor mean = Tensor::zeros({units}), variance = Tensor::zeros({units});
    for (Index unit = 0; unit < units; ++unit) {
      double sum = 0, squares = 0;
      for (Index i = 0; i < kSamples; ++i) {
        const double value = read.data<float>()[i * units + unit];
        sum += value, squares += value * value;
      }
      mean.data<float>()[unit] = static_cast<float>(sum / kSamples);
      variance.data<float>()[unit] = static_cast<float>(squares / kSamples - sum / kSamples * sum / kSamples);
    }
    model.head_parameters.set(node.name + "/moving_mean", mean);
    model.head_parameters.set(node.name + "/moving_variance", variance);
  }
}

Model pose_bench_model(frame::FrameChoice frame, const std::string& name, Index width) {
  const bool is_camera = frame == frame::FrameChoice::camera;
  const models::Backbone backbone = models::random_backbone(name,
                                                            is_camera             ? ""
                                                            : name == "mobilenet" ? "conv_pw_13_relu"
                                                                                  : "out_relu",
                                                            1);
  Model model;
  model.frame = frame;
  model.backbone = name;
  model.preprocessing = backbone.preprocessing();
  if (is_camera) {
    model.backbone_output = backbone.output_name();
    model.backbone_graph = backbone.graph();
    model.backbone_parameters = backbone.parameters();
    model.head = models::sv_net({.features = backbone.dimension(), .width = width, .angles = model.angles});
  } else {
    model.backbone_graph = models::projected_graph(models::pooled_graph(backbone.graph()), 150);
    model.backbone_output = model.backbone_graph.node(model.backbone_graph.output()).name;
    model.backbone_parameters = initial_parameters(model.backbone_graph, 1);
    model.head = models::linear_head(frame::input_count(frame_spec(model)));
  }
  model.head_parameters = initial_parameters(model.head, 1);
  if (is_camera) learn_statistics(model);
  return model;
}

Image pose_bench_image() {
  Image image{224, 224, {}};
  for (Index i = 0; i < image.height * image.width * 3; ++i) image.rgb.push_back(static_cast<std::uint8_t>(i * i / 97));
  return image;
}

/// `count` poses; 0: the features alone.
void whole_call(benchmark::State& state, const Model& model, Index count) {
  const predict::Predictor predictor(model, inference_options_from_environment());
  const Image image = pose_bench_image();
  const std::vector<view::CameraPose> poses = view::fibonacci_half_sphere(std::max<Index>(count, 1), 10);
  for (auto _ : state) {
    const Tensor features = predictor.embed(image);
    if (count > 0) benchmark::DoNotOptimize(predict::best_view(predictor.scores(features, poses)));
  }
}

void one_pose(benchmark::State& state, const Model& model, bool int8) {
  InferenceOptions options = inference_options_from_environment();
  options.int8_dense = int8;
  const predict::ScoreHead head(model, options);
  Tensor features = Tensor::empty({1, head.feature_count()});
  for (Index i = 0; i < features.size(); ++i) features.data<float>()[i] = static_cast<float>(i * i % 97) / 60;
  const view::CameraPose pose{30, 45};
  for (auto _ : state) benchmark::DoNotOptimize(head.scores(features, {&pose, 1}));
}

const bool kPoseBenchRegistered = [] {
  using frame::FrameChoice;
  const auto add_model = [](const std::string& what, const auto& model) {
    for (const Index count : {0, 1, 1000})
      benchmark::RegisterBenchmark(
          (count == 0 ? "backbone/" + what : joined("whole_call/", what, "/poses:", count)).c_str(),
          [=](benchmark::State& state) { whole_call(state, model(), count); })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
  };
  const auto add_head = [](const std::string& what, const auto& model) {
    for (const bool int8 : {false, true})
      benchmark::RegisterBenchmark(joined("head/", what, int8 ? "/int8" : "/f32").c_str(),
                                   [=](benchmark::State& state) { one_pose(state, model(), int8); })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
  };
  const auto add = [&](FrameChoice frame, const std::string& backbone, Index width = 0) {
    add_model(joined(name_of(frame), "/", backbone, width > 0 ? joined("/width:", width) : ""),
              [=] { return pose_bench_model(frame, backbone, width); });
  };
  if (const std::string file = environment_variable("SVNET_BENCH_MODEL"); !file.empty()) {
    add_model("file", [=] { return io::read_model(file); });
    add_head("file", [=] { return io::read_model(file); });
  }
  add(FrameChoice::camera, "vgg19", 4096);
  add_head("camera/vgg19", [] { return pose_bench_model(FrameChoice::camera, "vgg19", 4096); });
  for (const char* backbone : {"mobilenet", "mobilenet_v2"}) {
    for (const Index width : {256, 1024, 4096}) add(FrameChoice::camera, backbone, width);
    for (const FrameChoice frame : {FrameChoice::turned, FrameChoice::turned_axis}) add(frame, backbone);
  }
  return true;
}();

}  // namespace
}  // namespace svnet
