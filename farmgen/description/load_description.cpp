// SPDX-License-Identifier: Apache-2.0
#include "description/load_description.h"

#include "core/yaml_section.h"
#include "description/internal/sections.h"
#include "description/internal/shared_keys.h"
#include "planting/layout_table.h"

namespace plotscan::description {
namespace {

Anchor read_anchor(const YamlSection& section) {
  return {.latitude_deg = section.number("latitude_deg", {-89, 89}),  // at a pole there is no north
          .longitude_deg = section.number("longitude_deg", {-180, 180}),
          .altitude_m = section.number("altitude_m", {-1000, 10000}, 0.0)};
}

planting::LayoutDescription read_layout(const YamlSection& section) {
  planting::LayoutDescription layout;
  layout.plants = file_at(section, "plants");
  if (section.has("plots")) layout.plots = file_at(section, "plots");
  if (section.has("columns")) {
    const YamlSection columns = section.section("columns");
    columns.allow_only(planting::layout_columns());
    layout.columns = columns.texts();
  }
  return layout;
}

void read_explicit_plants(const YamlSection& root, planting::FarmDescription& description) {
  if (root.has("plants")) root.fail("layout", "takes the place of plants; give one of the two");
  const YamlSection section = root.section("layout");
  description.layout = read_layout(section);
  read_models(section, description.models);
  if (!description.trials.empty() && description.layout->plots)
    section.fail("plots", "takes the place of the plot grid; give one of the two");
}

}  // namespace

planting::FarmDescription load_description(const std::filesystem::path& file,
                                           const std::vector<std::string>& overrides) {
  const YamlSection root = YamlSection::load(file, overrides);
  planting::FarmDescription description;
  description.source = file;
  description.name = name_at(root, "name", file.stem().string());
  if (root.has("seed")) description.seed = root.unsigned_integer("seed");
  if (root.has("anchor")) description.anchor = read_anchor(root.section("anchor"));
  description.terrain = read_terrain(root.section("terrain"));
  const bool sown = !root.has("layout");
  description.trials = read_trials(root, sown, description.models);
  if (!sown) read_explicit_plants(root, description);
  if (root.has("weeds")) description.weeds = read_weeds(root.section("weeds"), description.models);
  root.refuse_unread();
  return description;
}

}  // namespace plotscan::description
