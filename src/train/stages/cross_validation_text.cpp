#include "train/stages/cross_validation_text.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "train/evaluation_text.h"

namespace svnet::train {
namespace {

using nlohmann::ordered_json;

std::string within_pose_text(const WithinPose& w) {
  char text[200];
  std::snprintf(
      text, sizeof text,
      "Spearman %.3f, regret %.3f, better than the top view %.1f %%, than a random view %.1f %% of %lld poses",
      w.spearman, w.regret, 100 * w.better_than_top, 100 * w.better_than_rand, static_cast<long long>(w.poses));
  return text;
}

ordered_json within_pose_json(const WithinPose& w) {
  return {{"poses", w.poses},
          {"spearman", w.spearman},
          {"regret", w.regret},
          {"better_than_top", w.better_than_top},
          {"better_than_rand", w.better_than_rand}};
}

}  // namespace

std::string cross_validation_text(const NamedCrossValidation& validation) {
  const CrossValidation& v = validation.result;
  std::string text =
      table_text(v.table, "Cross-validation over categories" +
                              (validation.settings.empty() ? std::string() : ", " + validation.settings)) +
      "Within poses: " + within_pose_text(v.within_pose) + "\n";
  for (const FoldResult& fold : v.folds)
    text += "  " + joined_with(", ", fold.held_out) + ": " + within_pose_text(fold.within_pose) + "\n";
  return text;
}

std::string cross_validation_json(const std::vector<NamedCrossValidation>& validations) {
  const CrossValidation& first = validations.front().result;
  ordered_json json{{"format", 1}, {"problems", first.table.problems}};
  json["pipelines"] = intervals_json(first.table);
  json["differences"] = differences_json(first.table);
  json["within_pose"] = within_pose_json(first.within_pose);
  for (const FoldResult& fold : first.folds)
    json["folds"].push_back({{"held_out", fold.held_out}, {"within_pose", within_pose_json(fold.within_pose)}});
  if (validations.size() > 1)
    for (const NamedCrossValidation& tried : validations)
      json["tried"].push_back({{"settings", tried.settings},
                               {"within_pose", within_pose_json(tried.result.within_pose)},
                               {"differences", differences_json(tried.result.table)}});
  return json.dump(2) + "\n";
}

}  // namespace svnet::train
