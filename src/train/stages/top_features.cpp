#include "train/stages/top_features.h"

#include "frame/frame_inputs.h"
#include "train/turned_features.h"
#include "train/turned_projection.h"

namespace svnet::train {

std::vector<float> top_features(const Run& run, FeaturesStage& features, const Model& model) {
  const frame::FrameSpec spec = frame_spec(model);
  std::vector<float> turns;
  if (frame::has_turns(spec.frame)) {
    const Features& turned = features.turned_features(run.config.sv_net.backbone, run.config.sv_net.layer);
    check_turned_rows(run.dataset, turned);
    turns = projected_turns(model, turned, run.inference);
  }
  const std::size_t per_pose = turns.size() / run.dataset.poses.size();
  std::vector<float> all;
  for (std::size_t pose = 0; pose < run.dataset.poses.size(); ++pose) {
    if (frame::has_axis(spec.frame)) {
      const frame::TopFrameValues values = frame::to_values(features.frames(spec.depth)[pose]);
      all.insert(all.end(), values.begin(), values.end());
    }
    const auto first = turns.begin() + static_cast<std::ptrdiff_t>(pose * per_pose);
    all.insert(all.end(), first, first + static_cast<std::ptrdiff_t>(per_pose));
  }
  return all;
}

}  // namespace svnet::train
