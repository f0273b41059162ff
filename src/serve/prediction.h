#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "predict/predictor.h"
#include "serve/prediction_request.h"

namespace svnet::serve {

/// The answer of POST /v1/predict: best (theta_deg, phi_deg, score, camera_pose), views (theta_deg, phi_deg, score;
/// best first) and top_view (distance, limit, trust), named as by svnet-predict --json, and notes: lines on what was
/// ignored or is unusual.
///
/// `image` is a PNG, JPEG or WebP file, `depth` a depth file or empty. Throws Refusal 415 if the image is none of
/// these, and Error if it is damaged, has more than 64 megapixels, or depth is missing.
nlohmann::ordered_json prediction_json(const predict::Predictor&, const PredictionRequest&, std::string_view image,
                                       std::string_view depth);

}  // namespace svnet::serve
