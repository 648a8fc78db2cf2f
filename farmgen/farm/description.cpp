// SPDX-License-Identifier: Apache-2.0
#include "farm/description.h"

#include <algorithm>
#include <numbers>
#include <set>
#include <string_view>

#include "core/error.h"
#include "core/yaml_section.h"
#include "farm/description_values.h"
#include "farm/layout_table.h"

namespace plotscan::farm {
namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr Range kScale = {0.01, 100};
constexpr Range kLatitude = {-89, 89};  // at a pole there is no north
constexpr Range kLongitude = {-180, 180};
constexpr Range kAltitude = {-1000, 10000};
constexpr Range kPlotSize = {0.05, 1000};
constexpr Range kGap = {0, 1000};
constexpr Range kPlace = {-100000, 100000};
constexpr Range kHeading = {-360, 360};
constexpr Range kJitter = {0, 10};
constexpr std::int64_t kMostPlantsPerPlot = 1'000'000;
constexpr std::size_t kMostRows = 10'000;
constexpr std::uint64_t kMostPlots = 100'000;
constexpr std::uint64_t kMostPlants = 10'000'000;
constexpr std::size_t kMostModels = 1000;
constexpr std::size_t kLongestName = 64;
constexpr std::string_view kNameCharacters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";

std::string name_at(const YamlSection& section, const std::string& key, std::string fallback) {
  for (char& c : fallback) {
    if (kNameCharacters.find(c) == std::string_view::npos) c = '_';
  }
  std::string name = section.text(key, fallback);
  if (name.size() > kLongestName || name.front() == '.' ||
      name.find_first_not_of(kNameCharacters) != std::string::npos) {
    section.fail(key, "\"" + name +
                          "\" is not a name: 1 to 64 letters, digits, '-', '_', '.', not beginning "
                          "with '.'");
  }
  return name;
}

Anchor read_anchor(const YamlSection& section) {
  section.allow_only({"latitude_deg", "longitude_deg", "altitude_m"});
  return {.latitude_deg = section.number("latitude_deg", kLatitude),
          .longitude_deg = section.number("longitude_deg", kLongitude),
          .altitude_m = section.number("altitude_m", kAltitude, 0.0)};
}

PlotGridDescription read_plot_grid(const YamlSection& section) {
  section.allow_only(
      {"width_m", "length_m", "gap_width_m", "gap_length_m", "heading_deg", "position_m", "rows"});
  PlotGridDescription grid;
  grid.width_m = section.number("width_m", kPlotSize);
  grid.length_m = section.number("length_m", kPlotSize);
  grid.gap_width_m = section.number("gap_width_m", kGap, 0.0);
  grid.gap_length_m = section.number("gap_length_m", kGap, 0.0);
  grid.heading_rad = section.number("heading_deg", kHeading, 0.0) * kRadians;
  const auto [x, y] = section.pair("position_m", kPlace, std::pair{0.0, 0.0});
  grid.position_m = {x, y};
  std::uint64_t total = 0;
  for (const YamlSection& row : section.list("rows", kMostRows)) {
    row.allow_only({"plots", "offset_m"});
    const auto plots = static_cast<std::uint32_t>(row.integer("plots", 1, kMostPlots));
    grid.rows.push_back({plots, row.number("offset_m", kPlace, 0.0)});
    total += plots;
  }
  if (total > kMostPlots) {
    section.fail("rows", "hold " + std::to_string(total) + " plots; at most " +
                             std::to_string(kMostPlots) + " are allowed");
  }
  return grid;
}

ModelDescription read_model(const YamlSection& section) {
  section.allow_only({"mesh", "name", "up", "unit_m", "foot"});
  ModelDescription model;
  model.mesh = file_at(section, "mesh");
  model.name = name_at(section, "name", model.mesh.stem().string());
  model.options = read_mesh_options(section);
  if (section.choice("foot", {"origin", "lowest"}, 0) == 1)
    model.options.foot = mesh::MeshFoot::lowest;
  if (model.name == "terrain") section.fail("name", "\"terrain\" is the terrain's own name");
  return model;
}

std::vector<ModelDescription> read_models(const YamlSection& section) {
  std::vector<ModelDescription> models;
  std::set<std::string> names;
  for (const YamlSection& entry : section.list("models", kMostModels, "mesh")) {
    models.push_back(read_model(entry));
    if (!names.insert(models.back().name).second) {
      section.fail("models", "has two models named \"" + models.back().name +
                                 "\"; give one of them another name");
    }
  }
  return models;
}

PlantsDescription read_plants(const YamlSection& section) {
  section.allow_only({"count", "pattern", "drill_rows", "jitter_m", "models", "scale"});
  PlantsDescription plants;
  plants.count = static_cast<std::uint32_t>(section.integer("count", 0, kMostPlantsPerPlot));
  if (section.choice("pattern", {"random", "drilled"}, 0) == 1) {
    plants.pattern = PlantPattern::drilled;
    plants.drill_rows = static_cast<std::uint32_t>(section.integer("drill_rows", 1, 10'000));
    plants.jitter_m = section.number("jitter_m", kJitter, 0.0);
  }
  for (const char* key : {"drill_rows", "jitter_m"}) {
    if (plants.pattern == PlantPattern::random && section.has(key)) {
      section.fail(key, "belongs to pattern: drilled; the pattern is random");
    }
  }
  const auto [min_scale, max_scale] = section.pair("scale", kScale, std::pair{1.0, 1.0});
  if (min_scale > max_scale) section.fail("scale", "is not [min, max]: min is the larger");
  plants.min_scale = min_scale;
  plants.max_scale = max_scale;
  return plants;
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

void require_countable(const YamlSection& root, const FarmDescription& description) {
  std::uint64_t plots = 0;
  for (const PlotRowDescription& row : description.plots->rows) plots += row.plots;
  const std::uint64_t plants = plots * description.plants->count;
  if (plants > kMostPlants) {
    root.section("plants").fail("count", "makes " + std::to_string(plants) + " plants in " +
                                             std::to_string(plots) + " plots; at most " +
                                             std::to_string(kMostPlants) + " are allowed");
  }
}

void read_random_plants(const YamlSection& root, FarmDescription& description) {
  if (!description.plots) root.fail("plots", "is missing");
  const YamlSection section = root.section("plants");
  description.plants = read_plants(section);
  description.models = read_models(section);
  require_countable(root, description);
}

void read_explicit_plants(const YamlSection& root, FarmDescription& description) {
  if (root.has("plants")) root.fail("layout", "takes the place of plants; give one of the two");
  const YamlSection section = root.section("layout");
  description.layout = read_layout(section);
  description.models = read_models(section);
  if (description.plots && description.layout->plots) {
    section.fail("plots", "takes the place of the plot grid; give one of the two");
  }
}

}  // namespace

FarmDescription load_description(const std::filesystem::path& file,
                                 const std::vector<std::string>& overrides) {
  const YamlSection root = YamlSection::load(file, overrides);
  root.allow_only({"name", "seed", "anchor", "terrain", "plots", "plants", "layout"});
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
  for (const ModelDescription& model : description.models) files.push_back(model.mesh);
  return files;
}

}  // namespace plotscan::farm
