#pragma once
#include <span>

#include "train/evaluation_text.h"
#include "train/run.h"

namespace svnet::train {

/// Writes the means of the tables for TensorBoard, as scalars such as "held_out/mobilenet_v2_ward/svnet/fm". With
/// `scores`, the true scores of held-out views (NaN: none), an image shows the half-spheres of some held-out objects:
/// the scores that SV-net predicts beside the true ones.
void write_evaluation_events(const Run& run, const EvaluationTables& tables, std::span<const double> predicted,
                             std::span<const double> scores);

}  // namespace svnet::train
