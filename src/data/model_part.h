#pragma once
#include "base/enum_names.h"

namespace svnet {

/// What of a model is exported:
///   all       top image and camera poses to scores; only of models in the frame `camera`
///   backbone  top image to features
///   head      features and camera poses to scores
enum class ModelPart { all, backbone, head };
constexpr auto enum_table(ModelPart) {
  return std::to_array<EnumName<ModelPart>>(
      {{ModelPart::all, "all"}, {ModelPart::backbone, "backbone"}, {ModelPart::head, "head"}});
}

}  // namespace svnet
