#pragma once
#include <string>
#include <vector>

#include "data/model.h"
#include "data/scores.h"
#include "train/run.h"
#include "train/stages/features.h"

namespace svnet::train {

/// Lines on what a model has learnt: how many categories, objects and top views it was trained on, and the mean
/// score of the views that it chooses beside those of fixed rules, random views and the best views. These are of the
/// validation categories, or of the training categories if there are none, which the lines say.
std::vector<std::string> training_summary(const Run& run, FeaturesStage& features, const Scores& scores,
                                          const Model& model);

}  // namespace svnet::train
