#pragma once
#include <nlohmann/json_fwd.hpp>

#include "data/model.h"

namespace svnet::io {

// The members "trained_on" and "held_out" of a model's description, which a program that only predicts does not need:
//   {"trained_on": {"categories", "objects", "top_views"},
//    "held_out": {"categories", "problems", "tables": {pipeline: {selector: {metric: {"mean", "standard_error"}}}}}}
// A standard error that is not known is null.

void write_origin(const Model& model, nlohmann::json& description);

/// Missing members leave the model as it is. Throws nlohmann::json::exception for members of another type.
void read_origin(const nlohmann::json& description, Model& model);

}  // namespace svnet::io
