// SPDX-License-Identifier: Apache-2.0
#include "farmbench/sweep.h"

#include <algorithm>

#include "core/csv.h"

namespace plotscan::farmbench {

using nlohmann::json;

std::vector<json> combination(const Sweep& sweep, std::size_t i) {
  std::vector<json> values(sweep.axes.size());
  for (std::size_t axis = values.size(); axis-- > 0;) {
    const auto& of_axis = sweep.axes[axis].values;
    values[axis] = of_axis[i % of_axis.size()];
    i /= of_axis.size();
  }
  return values;
}

std::string text_of(const json& value) {
  return value.is_number() ? format_number(value.get<double>()) : value.get<std::string>();
}

json to_json(const Sweep& sweep) {
  json axes = json::array();
  for (const SweepAxis& axis : sweep.axes)
    axes.push_back({{"key", axis.key}, {"values", axis.values}});
  json document = {{"axes", axes}, {"height", sweep.height}, {"truth", sweep.truth}};
  if (sweep.goal) document["goal"] = {{"rmse_m", sweep.goal->rmse_m}, {"found", sweep.goal->found}};
  return document;
}

Sweep sweep_from_json(const json& document) {
  Sweep sweep{.axes = {}, .height = document.at("height"), .truth = document.at("truth")};
  for (const json& axis : document.at("axes"))
    sweep.axes.push_back({axis.at("key"), axis.at("values")});
  if (document.contains("goal")) {
    const json& goal = document["goal"];
    sweep.goal = {.rmse_m = goal.at("rmse_m"), .found = goal.at("found")};
  }
  return sweep;
}

}  // namespace plotscan::farmbench
