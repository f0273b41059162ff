#pragma once
#include "train/config/config.h"
#include "train/evaluation.h"

namespace svnet::train {

/// The options that a configuration asks for. If it compares several views, SV-net is a baseline too, and as many
/// random views are.
EvaluationOptions evaluation_options(const Config& config, std::uint64_t problems);

}  // namespace svnet::train
