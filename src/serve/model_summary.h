#pragma once
#include <nlohmann/json_fwd.hpp>

#include "data/model.h"
#include "serve/limits.h"

namespace svnet::serve {

/// The answer of GET /v1/model: version of svnet, what the model takes, its frame and backbone, what it was trained on,
/// and the server's limits.
nlohmann::ordered_json model_json(const Model&, const Limits&);

}  // namespace svnet::serve
