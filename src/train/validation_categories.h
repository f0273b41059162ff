#pragma once
#include <vector>

#include "train/config/config.h"

namespace svnet::train {

/// Per category, whether it chooses the best checkpoint: training.validation_categories of those that are not held
/// out, drawn at random. Throws Error if that leaves fewer than 2 categories to train on.
std::vector<bool> validation_categories(const std::vector<bool>& held_out, const Config& config);

}  // namespace svnet::train
