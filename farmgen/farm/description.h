// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh_import.h"
#include <Eigen/Core>

#include "farm/geodesy.h"
#include "farm/terrain_description.h"

namespace plotscan::farm {

// A farm as its author describes it: what docs/farm-format.md says of farm.yaml, with the ranges
// checked, angles in radians and paths resolved against the file's folder.

struct PlotRowDescription {
  std::uint32_t plots = 0;
  double offset_m = 0;  // shifts the row along x before the grid is turned
};

// Rows of equal plots. Before the grid is turned, rows run along x (a plot's width) and follow each
// other along y (a plot's length).
struct PlotGridDescription {
  double width_m = 0;
  double length_m = 0;
  double gap_width_m = 0;                                // between neighbours in a row
  double gap_length_m = 0;                               // between rows
  double heading_rad = 0;                                // of the whole grid, counter-clockwise
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  // centre of the grid's bounding rectangle
  std::vector<PlotRowDescription> rows;
};

struct ModelDescription {
  std::string name;
  std::filesystem::path mesh;
  mesh::MeshImportOptions options;
};

enum class PlantPattern { random, drilled };

// Plants drawn at random into every plot.
struct PlantsDescription {
  std::uint32_t count = 0;  // a plot
  PlantPattern pattern = PlantPattern::random;
  std::uint32_t drill_rows = 1;  // drilled: rows along the plot's length
  double jitter_m = 0;           // drilled: uniform shift in [-jitter_m, jitter_m] along both axes
  double min_scale = 1;          // each axis' scale is uniform in [min_scale, max_scale]
  double max_scale = 1;
};

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
