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

std::string gain_text(const GainCheck& check) {
  char line[200];
  std::snprintf(
      line, sizeof line,
      "Gain over the top view: expected %+.3f, was %+.3f; the 80 %% interval holds %.1f %%, above 0: said %.1f %%, "
      "was %.1f %% of %lld poses\n",
      check.expected, check.gained, 100 * check.inside, 100 * check.probability, 100 * check.positive,
      static_cast<long long>(check.poses));
  std::string text = line;
  for (const GainCheck::Bin& bin : check.bins) {
    std::snprintf(line, sizeof line, "  said %2.0f to %3.0f %%: %.1f %% of %lld poses\n", 100 * bin.from,
                  100 * bin.from + 10, 100 * bin.positive, static_cast<long long>(bin.poses));
    text += line;
  }
  return text;
}

ordered_json gain_json(const GainCheck& check) {
  ordered_json json{{"poses", check.poses},      {"expected", check.expected},       {"gained", check.gained},
                    {"inside_80", check.inside}, {"probability", check.probability}, {"positive", check.positive}};
  for (const GainCheck::Bin& bin : check.bins)
    json["bins"].push_back(
        {{"from", bin.from}, {"poses", bin.poses}, {"probability", bin.probability}, {"positive", bin.positive}});
  return json;
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
  if (!v.gains.empty()) text += gain_text(checked(v.gains));
  return text;
}

std::string cross_validation_json(const std::vector<NamedCrossValidation>& validations) {
  const CrossValidation& first = validations.front().result;
  ordered_json json{{"format", 1}, {"problems", first.table.problems}};
  json["pipelines"] = intervals_json(first.table);
  json["differences"] = differences_json(first.table);
  json["within_pose"] = within_pose_json(first.within_pose);
  if (!first.gains.empty()) json["gain"] = gain_json(checked(first.gains));
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
