// SPDX-License-Identifier: Apache-2.0
#include "farm/weeds_description.h"

#include <tuple>

#include "core/yaml_section.h"
#include "farm/description_values.h"

namespace plotscan::farm {
namespace {

constexpr Range kDensity = {0, 1000};
constexpr Range kMargin = {0, 1000};

}  // namespace

WeedsDescription read_weeds(const YamlSection& section, std::vector<ModelDescription>& models) {
  section.allow_only({"per_m2", "where", "margin_m", "models", "scale"});
  WeedsDescription weeds;
  weeds.per_m2 = section.number("per_m2", kDensity);
  weeds.where =
      static_cast<WeedPlace>(section.choice("where", {"everywhere", "alleys", "plots"}, 0));
  weeds.margin_m = section.number("margin_m", kMargin, weeds.margin_m);
  std::tie(weeds.min_scale, weeds.max_scale) = scale_at(section);
  weeds.models = read_models(section, models);
  return weeds;
}

}  // namespace plotscan::farm
