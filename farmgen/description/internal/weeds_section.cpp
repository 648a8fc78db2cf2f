// SPDX-License-Identifier: Apache-2.0
#include <tuple>

#include "core/yaml_section.h"
#include "description/internal/sections.h"
#include "description/internal/shared_keys.h"

namespace plotscan::description {
planting::WeedsDescription read_weeds(const YamlSection& section,
                                      std::vector<planting::ModelDescription>& models) {
  planting::WeedsDescription weeds;
  weeds.per_m2 = section.number("per_m2", {0, 1000});
  weeds.where = static_cast<planting::WeedPlace>(
      section.choice("where", {"everywhere", "alleys", "plots"}, 0));
  weeds.margin_m = section.number("margin_m", {0, 1000}, weeds.margin_m);
  std::tie(weeds.min_scale, weeds.max_scale) = scale_at(section);
  weeds.models = read_models(section, models);
  return weeds;
}

}  // namespace plotscan::description
