// SPDX-License-Identifier: Apache-2.0
#include "farm/description.h"

#include "core/error.h"
#include "core/yaml_section.h"
#include "farm/description_values.h"
#include "farm/layout_table.h"

namespace plotscan::farm {
namespace {

constexpr Range kLatitude = {-89, 89};  // at a pole there is no north
constexpr Range kLongitude = {-180, 180};
constexpr Range kAltitude = {-1000, 10000};

Anchor read_anchor(const YamlSection& section) {
  section.allow_only({"latitude_deg", "longitude_deg", "altitude_m"});
  return {.latitude_deg = section.number("latitude_deg", kLatitude),
          .longitude_deg = section.number("longitude_deg", kLongitude),
          .altitude_m = section.number("altitude_m", kAltitude, 0.0)};
}

LayoutDescription read_layout(const YamlSection& section) {
  section.allow_only({"plants", "columns", "plots", "models"});
  LayoutDescription layout;
  layout.plants = file_at(section, "plants");
  if (section.has("plots")) layout.plots = file_at(section, "plots");
  if (section.has("columns")) {
    const YamlSection columns = section.section("columns");
    columns.allow_only(layout_columns());
    layout.columns = columns.texts();
  }
  return layout;
}

void read_random_plants(const YamlSection& root, FarmDescription& description) {
  if (!description.plots) root.fail("plots", "is missing");
  description.plants = read_plants(root.section("plants"), *description.plots, description.models);
}

void read_explicit_plants(const YamlSection& root, FarmDescription& description) {
  if (root.has("plants")) root.fail("layout", "takes the place of plants; give one of the two");
  const YamlSection section = root.section("layout");
  description.layout = read_layout(section);
  read_models(section, description.models);
  if (description.plots && description.layout->plots) {
    section.fail("plots", "takes the place of the plot grid; give one of the two");
  }
}

}  // namespace

FarmDescription load_description(const std::filesystem::path& file,
                                 const std::vector<std::string>& overrides) {
  const YamlSection root = YamlSection::load(file, overrides);
  root.allow_only({"name", "seed", "anchor", "terrain", "plots", "plants", "layout", "weeds"});
  FarmDescription description;
  description.source = file;
  description.name = name_at(root, "name", file.stem().string());
  if (root.has("seed")) description.seed = root.unsigned_integer("seed");
  if (root.has("anchor")) description.anchor = read_anchor(root.section("anchor"));
  description.terrain = read_terrain(root.section("terrain"));
  if (root.has("plots")) description.plots = read_plot_grid(root.section("plots"));
  if (root.has("layout")) {
    read_explicit_plants(root, description);
  } else {
    read_random_plants(root, description);
  }
  if (root.has("weeds")) description.weeds = read_weeds(root.section("weeds"), description.models);
  return description;
}

std::vector<std::filesystem::path> input_files(const FarmDescription& description) {
  std::vector<std::filesystem::path> files = {description.source};
  for (std::filesystem::path& file : terrain_files(description.terrain))
    files.push_back(std::move(file));
  if (description.layout) {
    files.push_back(description.layout->plants);
    if (description.layout->plots) files.push_back(*description.layout->plots);
  }
  for (std::filesystem::path& file : model_files(description.models))
    files.push_back(std::move(file));
  return files;
}

}  // namespace plotscan::farm
