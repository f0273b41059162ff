// From a top image to the scores of camera poses, by models with made-up weights.
//   backbone/<frame>/<backbone>          the features of one top image alone
//   whole_call/<frame>/<backbone>/poses  features, then the scores of that many poses and the best of them
// In the frame `camera` the name of the backbone is followed by the width of the head, 4096 by default.
// VGG19 in the frame `camera` is the paper's network: its head has 153 million weights.
#include <benchmark/benchmark.h>

#include "models/backbone.h"
#include "models/pose_head.h"
#include "models/turned_backbone.h"
#include "predict/predictor.h"
#include "view/pose_grid.h"

namespace svnet {
namespace {

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
  return model;
}

Image pose_bench_image() {
  Image image{224, 224, {}};
  for (Index i = 0; i < image.height * image.width * 3; ++i) image.rgb.push_back(static_cast<std::uint8_t>(i * i / 97));
  return image;
}

/// `count` poses; 0: the features alone.
void whole_call(benchmark::State& state, frame::FrameChoice frame, const std::string& backbone, Index width,
                Index count) {
  const predict::Predictor predictor(pose_bench_model(frame, backbone, width), inference_options_from_environment());
  const Image image = pose_bench_image();
  const std::vector<view::CameraPose> poses = view::fibonacci_half_sphere(std::max<Index>(count, 1), 10);
  for (auto _ : state) {
    const Tensor features = predictor.embed(image);
    if (count > 0) benchmark::DoNotOptimize(predict::best_view(predictor.scores(features, poses)));
  }
}

const bool kPoseBenchRegistered = [] {
  using frame::FrameChoice;
  const auto add = [](FrameChoice frame, const std::string& backbone, Index width = 0) {
    for (const Index count : {0, 1, 1000}) {
      const std::string what = joined(name_of(frame), "/", backbone, width > 0 ? joined("/width:", width) : "");
      benchmark::RegisterBenchmark(
          (count == 0 ? "backbone/" + what : joined("whole_call/", what, "/poses:", count)).c_str(),
          [=](benchmark::State& state) { whole_call(state, frame, backbone, width, count); })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
    }
  };
  add(FrameChoice::camera, "vgg19", 4096);
  for (const char* backbone : {"mobilenet", "mobilenet_v2"}) {
    for (const Index width : {256, 1024, 4096}) add(FrameChoice::camera, backbone, width);
    for (const FrameChoice frame : {FrameChoice::turned, FrameChoice::turned_axis}) add(frame, backbone);
  }
  return true;
}();

}  // namespace
}  // namespace svnet
