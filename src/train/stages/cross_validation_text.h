#pragma once
#include <string>
#include <vector>

#include "train/stages/cross_validation.h"

namespace svnet::train {

/// A cross-validation with the settings it was made with.
struct NamedCrossValidation {
  std::string settings;  ///< "scores.rounds=2", empty if nothing was varied
  CrossValidation result;
};

/// Tables for people.
std::string cross_validation_text(const NamedCrossValidation& validation);

/// crossval.json: of the first cross-validation "pipelines", "differences", "within_pose" and "folds" with their
/// "held_out"; if several were made, "tried" with the settings, within_pose and differences of each.
std::string cross_validation_json(const std::vector<NamedCrossValidation>& validations);

}  // namespace svnet::train
