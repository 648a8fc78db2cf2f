// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/geodesy.h"
#include "planting/model_description.h"
#include "planting/plants_description.h"
#include "planting/plots_description.h"
#include "planting/weeds_description.h"
#include "terrain/terrain_description.h"

namespace plotscan::planting {

// A farm's description: the content of farm.yaml (docs/farm-format.md), with ranges checked, angles
// in radians and paths resolved against the file's folder.

// Plants placed one by one by a table.
struct LayoutDescription {
  std::filesystem::path plants;                // CSV
  std::map<std::string, std::string> columns;  // our name of a column -> the table's
  std::optional<std::filesystem::path> plots;  // GeoJSON, in place of a plot grid
};

// Plots that lie on one grid, and what is sown into them.
struct TrialDescription {
  PlotGridDescription plots;
  std::optional<PlantsDescription> plants = {};  // absent where a layout places the plants
};

struct FarmDescription {
  std::filesystem::path source;  // the YAML file
  std::string name;
  std::optional<std::uint64_t> seed;
  std::optional<Anchor> anchor;
  terrain::TerrainDescription terrain;
  std::vector<TrialDescription> trials;  // no two of their plots have one number
  std::vector<ModelDescription> models;
  std::optional<LayoutDescription> layout;  // in place of the trials' plants
  std::optional<WeedsDescription> weeds;
};

// Every file that a farm made from the description depends on, the description first.
std::vector<std::filesystem::path> input_files(const FarmDescription& description);

}  // namespace plotscan::planting
