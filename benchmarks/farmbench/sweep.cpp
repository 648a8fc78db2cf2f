// SPDX-License-Identifier: Apache-2.0
#include "farmbench/sweep.h"

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

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SweepAxis, key, values)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SweepGoal, rmse_m, found)

void to_json(json& document, const Sweep& sweep) {
  document = {{"axes", sweep.axes}, {"height", sweep.height}, {"truth", sweep.truth}};
  if (sweep.goal) document["goal"] = *sweep.goal;
}

void from_json(const json& document, Sweep& sweep) {
  sweep = {
      .axes = document.at("axes"), .height = document.at("height"), .truth = document.at("truth")};
  if (document.contains("goal")) sweep.goal = document["goal"].get<SweepGoal>();
}

}  // namespace plotscan::farmbench
