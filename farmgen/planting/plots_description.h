// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/plot_numbering.h"

namespace plotscan::planting {

struct PlotRowDescription {
  std::uint32_t plots = 0;
  double offset_m = 0;  // shifts the row along x before the grid is turned
};

// The two steps of a lattice of plots, world frame, metres.
struct PlotPitch {
  Eigen::Vector2d column_m = Eigen::Vector2d::Zero();  // from a plot to the next in its row
  Eigen::Vector2d row_m = Eigen::Vector2d::Zero();     // from a row to the next
};

// The `plots` section of farm.yaml (docs/farm-format.md): rows of equal plots. Before the grid is
// turned, rows run along x (a plot's width) and follow each other along y (a plot's length).
struct PlotGridDescription {
  double width_m = 0;
  double length_m = 0;
  double gap_width_m = 0;                                // between neighbours in a row
  double gap_length_m = 0;                               // between rows
  double heading_rad = 0;                                // of the whole grid, counter-clockwise
  bool random_heading = false;                           // in its place: drawn from the farm's seed
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  // centre of the grid's bounding rectangle
  std::vector<PlotRowDescription> rows;
  double skew_rad = 0;  // turns the row-to-row axis further, away from perpendicular to the rows
  std::optional<PlotPitch> pitch = {};  // in place of gaps, heading and skew
  // Number of a row, of a column -> the width of the alley after it, in place of the gap.
  std::map<std::uint32_t, double> row_alleys_m = {};
  std::map<std::uint32_t, double> column_alleys_m = {};
  PlotNumbering numbering = PlotNumbering::rows;
  std::uint32_t first_number = 1;
  std::vector<std::uint32_t> missing = {};  // numbers of plots that are not there
  double missing_rate = 0;                  // and the share of others that are not
};

std::uint64_t plots_of(const PlotGridDescription& grid);
// The number of the last one.
std::uint32_t last_number(const PlotGridDescription& grid);
// Columns of the longest row.
std::uint32_t columns_of(const PlotGridDescription& grid);

}  // namespace plotscan::planting
