#include "io/models/model_origin.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace svnet::io {

using nlohmann::json;

void write_origin(const Model& model, json& description) {
  if (const TrainedOn& on = model.trained_on; !on.categories.empty())
    description["trained_on"] = {{"categories", on.categories}, {"objects", on.objects}, {"top_views", on.top_views}};
  const HeldOutResults& held_out = model.held_out;
  if (held_out.values.empty()) return;
  json tables = json::object();
  for (const auto& value : held_out.values)
    tables[value.pipeline][value.selector][value.metric] = {
        {"mean", value.mean},
        {"standard_error", std::isfinite(value.standard_error) ? json(value.standard_error) : json()}};
  description["held_out"] = {{"categories", held_out.categories}, {"problems", held_out.problems}, {"tables", tables}};
}

void read_origin(const json& description, Model& model) {
  if (description.contains("trained_on")) {
    const json& on = description.at("trained_on");
    model.trained_on = {on.at("categories").get<std::vector<std::string>>(), on.at("objects").get<Index>(),
                        on.at("top_views").get<Index>()};
  }
  if (!description.contains("held_out")) return;
  const json& from = description.at("held_out");
  from.at("categories").get_to(model.held_out.categories);
  from.at("problems").get_to(model.held_out.problems);
  for (const auto& [pipeline, selectors] : from.at("tables").items())
    for (const auto& [selector, metrics] : selectors.items())
      for (const auto& [metric, value] : metrics.items()) {
        const json& error = value.at("standard_error");
        model.held_out.values.push_back(
            {pipeline, selector, metric, value.at("mean").template get<double>(),
             error.is_null() ? std::numeric_limits<double>::quiet_NaN() : error.template get<double>()});
      }
}

}  // namespace svnet::io
