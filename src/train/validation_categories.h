#pragma once
#include <vector>

#include "train/config/config.h"

namespace svnet::train {

/// Returns, per category, whether it is one for validation: their loss chooses the best checkpoint. Draws
/// training.validation_categories of the categories that are not held out. Throws Error if fewer than 2 are left to
/// train on.
std::vector<bool> validation_categories(const std::vector<bool>& held_out, const Config& config);

/// How SV-net uses the categories that are not held out.
struct CategoryUse {
  std::vector<bool> learnt;    ///< per category
  std::vector<bool> validate;  ///< per category; none in other frames than `camera`, whose heads need no validation
};
CategoryUse category_use(const std::vector<bool>& held_out, const Config& config);

}  // namespace svnet::train
