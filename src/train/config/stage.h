#pragma once
#include "base/enum_names.h"

namespace svnet {

/// The stages of a run, in order: each one takes the results of those before it.
enum class Stage { features, scores, model, evaluation };
template <>
inline constexpr auto enum_names<Stage> = std::to_array<EnumName<Stage>>({{Stage::features, "features"},
                                                                          {Stage::scores, "scores"},
                                                                          {Stage::model, "model"},
                                                                          {Stage::evaluation, "evaluation"}});

}  // namespace svnet
