#include "train/config/preset.h"

namespace svnet::train {
namespace {

void set_turns(Config& config) {
  config.scores.backbone = "mobilenet_v2";
  config.sv_net.backbone = "mobilenet_v2";
  config.sv_net.layer = "out_relu";
  config.sv_net.width = 64;
  config.sv_net.dropout = 0.25;
  config.sv_net.angles = models::AngleEncoding::harmonics;
  config.sv_net.orientations = Orientations::all;
  config.training.augmentation = TopViewAugmentation::turns;
  config.training.epochs = 3;
  config.training.schedule = Schedule::Kind::cosine;
}

void set_best(Config& config) {
  config.scores.backbone = "mobilenet_v2";
  config.scores.rounds = 1;
  config.sv_net.backbone = "mobilenet_v2";
  config.sv_net.frame = frame::FrameChoice::axis;
}

}  // namespace

Config config_of(Preset preset) {
  Config config;
  config.preset = preset;
  switch (preset) {
    case Preset::paper:
      break;
    case Preset::turns:
      set_turns(config);
      break;
    case Preset::best:
      set_best(config);
      break;
  }
  return config;
}

}  // namespace svnet::train
