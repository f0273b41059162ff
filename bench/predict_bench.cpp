// embed/<frame>/<backbone>: features of one top image of the network's size, by a model with made-up weights. In the
// frame `camera` it is one embedding; in the frame `turned` it is that of all turns, to 150 components, with the scores
// of 21 camera poses.
#include <benchmark/benchmark.h>

#include "frame/turns.h"
#include "models/backbone.h"
#include "models/pose_head.h"
#include "models/turned_backbone.h"
#include "predict/predictor.h"
#include "view/pose_grid.h"

namespace svnet {
namespace {

constexpr const char* kBackbone = "mobilenet_v2";

Image grey_levels(Index side) {
  Image image{side, side, {}};
  for (Index i = 0; i < side * side * 3; ++i) image.rgb.push_back(static_cast<std::uint8_t>(i * i / 97));
  return image;
}

Model camera_model() {
  const models::Backbone backbone = models::random_backbone(kBackbone, "", 1);
  Model model;
  model.backbone = kBackbone;
  model.backbone_output = backbone.output_name();
  model.preprocessing = backbone.preprocessing();
  model.backbone_graph = backbone.graph();
  model.backbone_parameters = backbone.parameters();
  model.head = models::sv_net({.features = backbone.dimension(), .width = 64, .angles = model.angles});
  model.head_parameters = initial_parameters(model.head, 1);
  return model;
}

Model turned_model() {
  const models::Backbone backbone = models::random_backbone(kBackbone, "out_relu", 1);
  Model model;
  model.frame = frame::FrameChoice::turned;
  model.backbone = kBackbone;
  model.preprocessing = backbone.preprocessing();
  model.backbone_graph = models::projected_graph(models::pooled_graph(backbone.graph()), 150);
  model.backbone_output = model.backbone_graph.node(model.backbone_graph.output()).name;
  model.backbone_parameters = initial_parameters(model.backbone_graph, 1);
  model.head = models::linear_head(frame::input_count(frame_spec(model)));
  model.head_parameters = initial_parameters(model.head, 1);
  return model;
}

void embed_camera(benchmark::State& state) {
  const predict::Predictor predictor(camera_model(), inference_options_from_environment());
  const Image image = grey_levels(224);
  for (auto _ : state) benchmark::DoNotOptimize(predictor.embed(image));
}

void embed_turned(benchmark::State& state) {
  const predict::Predictor predictor(turned_model(), inference_options_from_environment());
  const Image image = grey_levels(224);
  std::vector<view::CameraPose> poses = view::paper_grid();
  poses.pop_back();
  for (auto _ : state) benchmark::DoNotOptimize(predictor.scores(predictor.embed(image), poses));
}

void turned_images(benchmark::State& state) {
  const Image image = grey_levels(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(frame::turned_images(image, 224));
}

const bool kRegistered = [] {
  const auto add = [](const char* frame, void (*function)(benchmark::State&)) {
    benchmark::RegisterBenchmark((std::string("embed/") + frame + "/" + kBackbone).c_str(), function)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  };
  add("camera", embed_camera);
  add("turned", embed_turned);
  return true;
}();
BENCHMARK(turned_images)->ArgName("side")->Arg(224)->Arg(1080)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace svnet
