#pragma once
#include <string>

#include "predict/score_head.h"

namespace svnet::predict {

/// What a person should know of a top view whose shape is unlike those of the training; empty if it is not.
std::string familiarity_note(const Familiarity& familiarity);

}  // namespace svnet::predict
