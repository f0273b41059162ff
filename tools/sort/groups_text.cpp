#include "sort/groups_text.h"

#include <nlohmann/json.hpp>

#include "base/text.h"

namespace svnet {
using Json = nlohmann::ordered_json;

std::string groups_text(const Grouping& grouping, const std::vector<SortedObject>& objects) {
  std::string text;
  std::size_t number = 0;
  for (const auto& members : members_of(grouping)) {
    std::vector<std::string> names;
    names.reserve(members.size());
    for (const std::size_t i : members) names.push_back(objects[i].name);
    text += joined(number == 0 ? "" : "\n", number + 1, ": ", joined_with(", ", names));
    ++number;
  }
  return text;
}

std::string groups_json(const Grouping& grouping, const std::vector<SortedObject>& objects,
                        const GroupingChoices& choices) {
  Json groups = Json::array(), items = Json::array(), merges = Json::array();
  for (const auto& members : members_of(grouping)) {
    Json names = Json::array();
    for (const std::size_t i : members) names.push_back(objects[i].name);
    groups.push_back(Json{{"group", groups.size() + 1}, {"objects", std::move(names)}});
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    Json pictures = Json::array();
    for (const auto& picture : objects[i].pictures) pictures.push_back(picture.string());
    items.push_back(Json{{"name", objects[i].name}, {"group", grouping.group[i] + 1}, {"pictures", pictures}});
  }
  for (const semantics::Merge& merge : grouping.history.merges)
    merges.push_back(Json::array({merge.a, merge.b, merge.height, merge.size}));
  const Json document{{"count", grouping.groups},        {"estimated", choices.estimated},
                      {"backbone", choices.backbone},    {"weights_sha256", choices.weights_sha256},
                      {"linkage", choices.linkage},      {"fusion", choices.fusion},
                      {"groups", std::move(groups)},     {"objects", std::move(items)},
                      {"dendrogram", std::move(merges)}, {"cut_height", grouping.cut_height}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace svnet
