#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "predict/predictor.h"
#include "view/camera_pose.h"

namespace svnet {

/// What svnet-predict prints of a top image.
struct Prediction {
  std::vector<view::CameraPose> poses;
  std::vector<float> scores;
  std::vector<std::size_t> best;  // the best views that differ enough
  std::optional<float> margin_over_top;  // none: views were taken, and the scores are those of the next one
  std::optional<predict::Gain> gain;  // none: the model does not know
  predict::Familiarity familiarity;
};

/// A line per pose of `indices`, below a line of titles.
std::string table_text(const Prediction& prediction, const std::vector<std::size_t>& indices);

/// What moving the camera gains, in a sentence. Requires prediction.gain.
std::string gain_text(const predict::Gain& gain);

/// The members that --json prints.
nlohmann::ordered_json prediction_json(const Prediction& prediction);

}  // namespace svnet
