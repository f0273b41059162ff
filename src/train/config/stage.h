#pragma once
#include "base/enum_names.h"

namespace svnet::train {

/// The stages of a run, in order: each one takes the results of those before it.
enum class Stage { features, scores, model, evaluation };
constexpr auto enum_table(Stage) {
  return std::to_array<EnumName<Stage>>({{Stage::features, "features"},
                                         {Stage::scores, "scores"},
                                         {Stage::model, "model"},
                                         {Stage::evaluation, "evaluation"}});
}

}  // namespace svnet::train
