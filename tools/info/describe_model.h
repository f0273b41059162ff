#pragma once
#include <string>

#include "data/model.h"

namespace svnet {

/// What a person wants to know of a trained model, as lines: what it takes, backbone and layer, frame and depth, head,
/// the convention of angles, what it was trained on, and how far shapes may be from those of the training.
std::string description_of(const Model& model);

}  // namespace svnet
