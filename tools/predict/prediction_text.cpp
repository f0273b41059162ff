#include "predict/prediction_text.h"

#include <cstdio>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

namespace svnet {
using view::CameraPose;

namespace {

nlohmann::ordered_json views_json(const Prediction& prediction, const std::vector<std::size_t>& indices) {
  nlohmann::ordered_json views = nlohmann::ordered_json::array();
  for (const std::size_t i : indices) {
    const CameraPose& pose = prediction.poses[i];
    views.push_back({{"theta_deg", pose.theta_deg}, {"phi_deg", pose.phi_deg}, {"score", prediction.scores[i]}});
  }
  return views;
}

}  // namespace

std::string table_text(const Prediction& prediction, const std::vector<std::size_t>& indices) {
  std::ostringstream text;
  text << std::setw(10) << "theta" << std::setw(10) << "phi" << std::setw(12) << "score";
  for (const std::size_t i : indices)
    text << '\n'
         << std::setw(10) << prediction.poses[i].theta_deg << std::setw(10) << prediction.poses[i].phi_deg
         << std::setw(12) << std::fixed << std::setprecision(6) << prediction.scores[i] << std::defaultfloat;
  return text.str();
}

nlohmann::ordered_json prediction_json(const Prediction& prediction) {
  const nlohmann::ordered_json views = views_json(prediction, predict::best_first(prediction.scores));
  const predict::Familiarity& top_view = prediction.familiarity;
  const nlohmann::ordered_json top{
      {"distance", top_view.distance}, {"limit", top_view.limit}, {"trust", top_view.trust}};
  nlohmann::ordered_json json{{"best", views.front()}, {"best_views", views_json(prediction, prediction.best)}};
  if (prediction.margin_over_top) json["margin_over_top"] = *prediction.margin_over_top;
  json["views"] = views;
  json["top_view"] = top;
  if (const auto& gain = prediction.gain)
    json["gain"] = {
        {"expected", gain->expected}, {"low", gain->low}, {"high", gain->high}, {"probability", gain->probability}};
  return json;
}

std::string gain_text(const predict::Gain& gain) {
  char text[160];
  std::snprintf(text, sizeof text,
                "moving from the top view to the best pose: score %+.3f expected, %+.3f to %+.3f in 80 %% of cases, "
                "above 0 in %.0f %%",
                gain.expected, gain.low, gain.high, 100 * gain.probability);
  return text;
}

}  // namespace svnet
