// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/geodesy.h"
#include "farm/model_description.h"
#include "farm/plants_description.h"
#include "farm/plots_description.h"
#include "farm/terrain_description.h"
#include "farm/weeds_description.h"

namespace plotscan::farm {

// A farm as its author describes it: what docs/farm-format.md says of farm.yaml, with the ranges
// checked, angles in radians and paths resolved against the file's folder.

// Plants placed one by one by a table.
struct LayoutDescription {
  std::filesystem::path plants;                // CSV
  std::map<std::string, std::string> columns;  // our name of a column -> the table's
  std::optional<std::filesystem::path> plots;  // GeoJSON, in place of a plot grid
};

struct FarmDescription {
  std::filesystem::path source;  // the YAML file
  std::string name;
  std::optional<std::uint64_t> seed;
  std::optional<Anchor> anchor;
  TerrainDescription terrain;
  std::optional<PlotGridDescription> plots;
  std::vector<ModelDescription> models;
  // One of the two.
  std::optional<PlantsDescription> plants;
  std::optional<LayoutDescription> layout;
  std::optional<WeedsDescription> weeds;
};

// Reads a farm description. `overrides` are "key=value" with a dotted key ("terrain.relief_m=1",
// "plots.rows.0.plots=5") and replace what the file says. Throws InputError on an unknown key, a
// wrong type, an impossible value or a file that does not exist, naming file and line (or the
// override), key and what is allowed.
FarmDescription load_description(const std::filesystem::path& file,
                                 const std::vector<std::string>& overrides = {});

// Every file that a farm made from the description depends on, the description first.
std::vector<std::filesystem::path> input_files(const FarmDescription& description);

}  // namespace plotscan::farm
