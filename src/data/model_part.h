#pragma once
#include "base/enum_names.h"

namespace svnet {

/// What of a model is exported:
///   all       top image and camera poses to scores; only of models in the frame `camera`
///   backbone  top image to features
///   head      features and camera poses to scores
///   next      the inputs of frame/next_inputs.h to scores; only of models that know which view to take next
enum class ModelPart { all, backbone, head, next };
constexpr auto enum_table(ModelPart) {
  return std::to_array<EnumName<ModelPart>>({{ModelPart::all, "all"},
                                             {ModelPart::backbone, "backbone"},
                                             {ModelPart::head, "head"},
                                             {ModelPart::next, "next"}});
}

}  // namespace svnet
